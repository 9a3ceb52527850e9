// What the page takes from the library. Written by tools/explorer_facts.py: change nothing here.
gearpair.define("library", [], () => ({
  "numbers": [
    {
      "name": "mesh_frequency",
      "symbol": "Ω<sub>h</sub>",
      "label": "Mesh frequency",
      "value": 0.7,
      "min": 0.2,
      "max": 3.0,
      "step": 0.001,
      "lowest": 0.2,
      "highest": 3.0
    },
    {
      "name": "damping_ratio",
      "symbol": "ζ",
      "label": "Damping ratio",
      "value": 0.02,
      "min": 0.0,
      "max": 0.2,
      "step": 0.0005,
      "lowest": 0.0,
      "highest": 0.2
    },
    {
      "name": "mean_force",
      "symbol": "F<sub>m</sub>′",
      "label": "Mean force",
      "value": 0.1,
      "min": 0.0,
      "max": 0.5,
      "step": 0.005,
      "lowest": 0.0,
      "highest": 0.5
    },
    {
      "name": "error_amplitude",
      "symbol": "F<sub>ah</sub>",
      "label": "Error amplitude",
      "value": 0.2,
      "min": 0.0,
      "max": 1.0,
      "step": 0.005,
      "lowest": 0.0,
      "highest": 1.0
    },
    {
      "name": "error_phase",
      "symbol": "φ<sub>h</sub>",
      "label": "Error phase (rad)",
      "value": 0.0,
      "min": -3.14,
      "max": 3.14,
      "step": 0.01,
      "lowest": -6.3,
      "highest": 6.3
    },
    {
      "name": "contact_ratio",
      "symbol": "ε",
      "label": "Contact ratio",
      "value": 1.68,
      "min": 1.05,
      "max": 1.95,
      "step": 0.005,
      "lowest": 1.01,
      "highest": 1.99
    },
    {
      "name": "a",
      "symbol": "a",
      "label": "Added in double contact",
      "value": 0.116,
      "min": 0.0,
      "max": 1.0,
      "step": 0.002,
      "lowest": 0.0,
      "highest": 1.0
    },
    {
      "name": "b",
      "symbol": "b",
      "label": "Missing in single contact",
      "value": 0.414,
      "min": 0.0,
      "max": 0.9,
      "step": 0.002,
      "lowest": 0.0,
      "highest": 0.9
    },
    {
      "name": "x",
      "symbol": "X<sub>0</sub>",
      "label": "Displacement",
      "value": 1.0,
      "min": -6.0,
      "max": 6.0,
      "step": 0.01,
      "lowest": -1000.0,
      "highest": 1000.0
    },
    {
      "name": "v",
      "symbol": "X<sub>0</sub>′",
      "label": "Velocity",
      "value": 0.0,
      "min": -6.0,
      "max": 6.0,
      "step": 0.01,
      "lowest": -1000.0,
      "highest": 1000.0
    },
    {
      "name": "flight_damping",
      "symbol": "ζ<sub>f</sub>",
      "label": "Damping ratio in free flight",
      "value": null,
      "min": 0.0,
      "max": 0.2,
      "step": 0.0005,
      "lowest": 0.0,
      "highest": 0.2
    }
  ],
  "choices": [
    {
      "name": "reading",
      "value": "printed",
      "choices": [
        "printed",
        "swapped"
      ]
    },
    {
      "name": "diagram",
      "value": "mesh_frequency",
      "choices": [
        "mesh_frequency",
        "damping_ratio",
        "mean_force",
        "error_amplitude"
      ]
    }
  ],
  "motions": [
    "period 1",
    "period 2",
    "period 3",
    "period 4",
    "period 6",
    "period 8",
    "other periods",
    "chaos",
    "chaotic transient",
    "unsettled",
    "floating",
    "escaped"
  ],
  "impacts": {
    "never_in_contact": "never in contact",
    "none_drive": "no impact",
    "none_coast": "no impact on the coast side",
    "single_drive": "single-sided",
    "single_coast": "single-sided on the coast side",
    "double": "double-sided"
  },
  "words": {
    "aperiodic": "chaos",
    "transient": "chaotic transient"
  },
  "settling": {
    "maxPeriod": 64,
    "exponentPeriods": 2000,
    "manyExponentPeriods": 500,
    "watch": 20000,
    "samples": 256
  },
  "tolerances": {
    "DEGREE": 15,
    "REACH": 0.6,
    "ESCAPE_RADIUS": 1000000.0,
    "MAX_EVENTS_PER_PERIOD": 10000,
    "MAX_STEPS": 400,
    "NEWTON_STEPS": 40,
    "NEWTON_ROUNDING": 1e-13,
    "SAME_POINT": 1e-09,
    "RETURNED": 1e-08,
    "CAPTURED": 1e-06,
    "STABLE": 0.999999999,
    "MOST_TRACE": 10.0,
    "NEAR": 0.01,
    "RESOLVED": 4.0,
    "ROUNDING": 1e-09,
    "EXPONENT_BLOCKS": 20
  }
}));
