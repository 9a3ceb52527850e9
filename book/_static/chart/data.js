// Written by `python -m tools.chart_data` from the library; change it there.
gearpair.define("chart/data", [], function () {
  return {
  "groups": [
    {
      "title": "Teeth",
      "fields": [
        {
          "name": "pinion_teeth",
          "label": "teeth of the pinion",
          "unit": "",
          "value": 28,
          "symbol": "z1",
          "meaning": "teeth of the pinion, which drives",
          "default": null,
          "whole": true,
          "limits": {
            "at_least": 3
          }
        },
        {
          "name": "gear_teeth",
          "label": "teeth of the gear",
          "unit": "",
          "value": 57,
          "symbol": "z2",
          "meaning": "teeth of the gear",
          "default": null,
          "whole": true,
          "limits": {
            "at_least": 3
          }
        },
        {
          "name": "module_mm",
          "label": "module",
          "unit": "mm",
          "value": 3.0,
          "symbol": "m",
          "meaning": "module",
          "default": null,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "face_width_mm",
          "label": "face width",
          "unit": "mm",
          "value": 25.0,
          "symbol": "b",
          "meaning": "face width of both gears",
          "default": null,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "pinion_shift",
          "label": "profile shift of the pinion",
          "unit": "modules",
          "value": 0.0,
          "symbol": "x1",
          "meaning": "profile shift of the pinion",
          "default": 0.0,
          "whole": false,
          "limits": {}
        },
        {
          "name": "gear_shift",
          "label": "profile shift of the gear",
          "unit": "modules",
          "value": 0.0,
          "symbol": "x2",
          "meaning": "profile shift of the gear",
          "default": 0.0,
          "whole": false,
          "limits": {}
        }
      ]
    },
    {
      "title": "Load and errors",
      "fields": [
        {
          "name": "pinion_torque_nm",
          "label": "torque of the pinion",
          "unit": "N m",
          "value": 120.0,
          "symbol": "T1",
          "meaning": "driving torque, of either sign, or a list",
          "default": null,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "backlash_um",
          "label": "backlash",
          "unit": "um",
          "value": 100.0,
          "symbol": "",
          "meaning": "whole backlash, as the next line says",
          "default": null,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "backlash",
          "label": "stated as",
          "unit": "",
          "value": "normal",
          "symbol": "",
          "meaning": "along the line of action; or circumferential, or thickness: of both gears' teeth together",
          "default": "normal",
          "choices": [
            "normal",
            "circumferential",
            "thickness"
          ]
        },
        {
          "name": "transmission_error_um",
          "label": "transmission error, amplitude",
          "unit": "um",
          "value": 4.0,
          "symbol": "",
          "meaning": "amplitude of the static transmission error, phase unknown; or all harmonics, [[order, amplitude, phase]]",
          "default": null,
          "whole": false,
          "limits": {
            "at_least": 0.0
          }
        },
        {
          "name": "damping_ratio",
          "label": "damping ratio",
          "unit": "",
          "value": 0.05,
          "symbol": "zeta",
          "meaning": "damping ratio of the mesh: an assumption, known to a factor of two",
          "default": 0.05,
          "whole": false,
          "limits": {
            "at_least": 0.0,
            "at_most": 100.0
          }
        }
      ]
    },
    {
      "title": "Rack and bodies",
      "fields": [
        {
          "name": "pressure_angle_deg",
          "label": "pressure angle",
          "unit": "degrees",
          "value": 20.0,
          "symbol": "alpha",
          "meaning": "pressure angle of the rack",
          "default": 20.0,
          "whole": false,
          "limits": {
            "above": 0.0,
            "below": 90.0
          }
        },
        {
          "name": "addendum",
          "label": "addendum",
          "unit": "modules",
          "value": 1.0,
          "symbol": "",
          "meaning": "addendum of the rack",
          "default": 1.0,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "clearance",
          "label": "clearance",
          "unit": "modules",
          "value": 0.25,
          "symbol": "",
          "meaning": "clearance",
          "default": 0.25,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "bore_ratio",
          "label": "bore radius / pitch radius",
          "unit": "",
          "value": 0.3,
          "symbol": "",
          "meaning": "radius of both bores over the pitch radius; 0 is solid",
          "default": 0.3,
          "whole": false,
          "limits": {
            "at_least": 0.0
          }
        },
        {
          "name": "pinion_added_inertia_kg_m2",
          "label": "added inertia, pinion",
          "unit": "kg m^2",
          "value": 0.0,
          "symbol": "",
          "meaning": "inertia of what turns rigidly with the pinion",
          "default": 0.0,
          "whole": false,
          "limits": {
            "at_least": 0.0
          }
        },
        {
          "name": "gear_added_inertia_kg_m2",
          "label": "added inertia, gear",
          "unit": "kg m^2",
          "value": 0.0,
          "symbol": "",
          "meaning": "inertia of what turns rigidly with the gear",
          "default": 0.0,
          "whole": false,
          "limits": {
            "at_least": 0.0
          }
        }
      ]
    },
    {
      "title": "ISO 6336-1, and the ends of the chart",
      "fields": [
        {
          "name": "base_pitch_um",
          "label": "base pitch deviation",
          "unit": "um",
          "value": 8.0,
          "symbol": "f_pb",
          "meaning": "base pitch deviation, for ISO's dynamic factor alone",
          "default": null,
          "whole": false,
          "limits": {
            "at_least": 0.0
          }
        },
        {
          "name": "profile_um",
          "label": "profile form deviation",
          "unit": "um",
          "value": 8.0,
          "symbol": "f_falpha",
          "meaning": "profile form deviation, likewise",
          "default": null,
          "whole": false,
          "limits": {
            "at_least": 0.0
          }
        },
        {
          "name": "lowest_rpm",
          "label": "first speed",
          "unit": "rpm",
          "value": null,
          "symbol": "",
          "meaning": "where the chart begins; around the mesh resonance, unless given",
          "default": null,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        },
        {
          "name": "highest_rpm",
          "label": "last speed",
          "unit": "rpm",
          "value": null,
          "symbol": "",
          "meaning": "where it ends",
          "default": null,
          "whole": false,
          "limits": {
            "above": 0.0
          }
        }
      ]
    }
  ],
  "steel": {
    "youngs_modulus_gpa": 206.8,
    "poisson_ratio": 0.3
  },
  "n_levels": 16,
  "n_speeds": 121,
  "n_starts": 12,
  "n_phases": 8,
  "settle": {
    "maxPeriod": 16,
    "exponentPeriods": 300,
    "samples": 16
  },
  "reach": {
    "first": 0.15,
    "last": 1.35,
    "beyond": 1.1
  },
  "narrowest": 0.05,
  "losses": [
    "",
    "float in the backlash without impacts",
    "part after a shock alone, not when run up or down",
    "part or stay in contact, depending on how the speed is reached",
    "part and strike, however the speed is reached",
    "strike on both flanks",
    "leave what the model can follow"
  ],
  "impacts": {
    "never_in_contact": "never in contact",
    "none_drive": "no impact",
    "none_coast": "no impact on the coast side",
    "single_drive": "single-sided",
    "single_coast": "single-sided on the coast side",
    "double": "double-sided",
    "": "not bounded"
  },
  "flexibility": [
    0.04723,
    0.15551,
    0.25791,
    -0.00635,
    -0.11654,
    -0.00193,
    -0.24188,
    0.00529,
    0.00182
  ],
  "steel_mpa": 206000.0
};
});
