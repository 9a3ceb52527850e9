"""A real drive over its speeds: the chart, what changes it, the standard's factor beside it, rattle without load."""

from gearpair.design.charts import speed_chart
from gearpair.design.dynamic_factor import IsoDynamicFactor, iso_dynamic_factor
from gearpair.design.idle import IdleRattle, idle_oscillator, idle_rattle
from gearpair.design.jumps import Jump, find_jumps
from gearpair.design.linear import LinearResponse, linear_response
from gearpair.design.loads import measure_motion
from gearpair.design.passages import load_change, run_up, schedule
from gearpair.design.players import Player
from gearpair.design.sensitivities import sensitivity
from gearpair.design.shocks import shock_margin
from gearpair.design.sounds import Sound, sound, write_wav
from gearpair.design.speed_ranges import SpeedRange, speed_range_table, speeds_to_avoid

__all__ = [
    "IdleRattle",
    "IsoDynamicFactor",
    "Jump",
    "LinearResponse",
    "Player",
    "Sound",
    "SpeedRange",
    "find_jumps",
    "idle_oscillator",
    "idle_rattle",
    "iso_dynamic_factor",
    "linear_response",
    "load_change",
    "measure_motion",
    "run_up",
    "schedule",
    "sensitivity",
    "shock_margin",
    "sound",
    "speed_chart",
    "speed_range_table",
    "speeds_to_avoid",
    "write_wav",
]
