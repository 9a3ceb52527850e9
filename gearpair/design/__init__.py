"""A real drive over its speeds and loads: chart and map, what changes them, the standard's factor, idle rattle."""

from gearpair.design.charts import chart_speeds, speed_chart
from gearpair.design.dynamic_factor import IsoDynamicFactor, iso_dynamic_factor
from gearpair.design.identification import Identification, identify
from gearpair.design.idle import IdleRattle, idle_oscillator, idle_rattle
from gearpair.design.jumps import Jump, find_jumps
from gearpair.design.linear import LinearResponse, linear_response
from gearpair.design.load_maps import duty_cycle, load_map
from gearpair.design.loads import measure_motion
from gearpair.design.passages import how_many_moments, load_change, load_change_moments, run_up, schedule
from gearpair.design.players import Player
from gearpair.design.populations import helps_most, population
from gearpair.design.sensitivities import sensitivity
from gearpair.design.shocks import shock_margin
from gearpair.design.sounds import Sound, sound, write_wav
from gearpair.design.speed_ranges import SpeedRange, speed_range_table, speeds_to_avoid
from gearpair.design.verdicts import Verdict, verdict

__all__ = [
    "Identification",
    "IdleRattle",
    "IsoDynamicFactor",
    "Jump",
    "LinearResponse",
    "Player",
    "Sound",
    "SpeedRange",
    "Verdict",
    "chart_speeds",
    "duty_cycle",
    "find_jumps",
    "helps_most",
    "how_many_moments",
    "identify",
    "idle_oscillator",
    "idle_rattle",
    "iso_dynamic_factor",
    "linear_response",
    "load_change",
    "load_change_moments",
    "load_map",
    "measure_motion",
    "population",
    "run_up",
    "schedule",
    "sensitivity",
    "shock_margin",
    "sound",
    "speed_chart",
    "speed_range_table",
    "speeds_to_avoid",
    "verdict",
    "write_wav",
]
