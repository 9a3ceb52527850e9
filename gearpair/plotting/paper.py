"""What stays legible whatever it is drawn on: the book's light paper, or a dark style's."""

from collections.abc import Mapping
from colorsys import hls_to_rgb, rgb_to_hls
from typing import Any

from matplotlib import rcParams
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.cbook import normalize_kwargs
from matplotlib.colors import to_hex, to_rgb, to_rgba
from matplotlib.typing import ColorType

LEAST_CONTRAST = 3.0  # of what is drawn to what is under it: WCAG 2.1, criterion 1.4.11
DIMMEST = 0.15  # lightness of what is faint on a dark ground


def paper(ax: Axes) -> str:
    """The colour of what is drawn on: of the axes, or of the figure behind transparent ones."""
    own = ax.get_facecolor()
    return to_hex(own if to_rgba(own)[3] > 0.5 else ax.figure.get_facecolor())


def luminance(colour: ColorType) -> float:
    """Relative luminance, 0 of black and 1 of white (WCAG 2.1)."""
    linear = (part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in to_rgb(colour))
    return sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), linear, strict=True))


def contrast(one: ColorType, other: ColorType) -> float:
    """The contrast of two colours, 1 to 21 (WCAG 2.1)."""
    low, high = sorted([luminance(one), luminance(other)])
    return (high + 0.05) / (low + 0.05)


def is_dark(ax: Axes) -> bool:
    """Whether black would be lost on it sooner than white."""
    return contrast(paper(ax), "black") < contrast(paper(ax), "white")


def legible(ax: Axes, colour: ColorType) -> ColorType:
    """A colour of the light page as it is, but on dark axes as light as it has to be there: black becomes white."""
    if not is_dark(ax) or contrast(colour, paper(ax)) >= LEAST_CONTRAST:
        return colour
    hue, lightness, saturation = rgb_to_hls(*to_rgb(colour))
    lightness = max(lightness, 1.0 - lightness)
    while lightness < 1.0 and contrast(hls_to_rgb(hue, lightness, saturation), paper(ax)) < LEAST_CONTRAST:
        lightness = min(lightness + 0.05, 1.0)
    return to_hex(hls_to_rgb(hue, lightness, saturation))


def faint(ax: Axes, colour: ColorType) -> ColorType:
    """A pale colour of the light page as it is, and on dark axes as dim as it was pale."""
    if not is_dark(ax):
        return colour
    hue, lightness, saturation = rgb_to_hls(*to_rgb(colour))
    return to_hex(hls_to_rgb(hue, max(1.0 - lightness, DIMMEST), saturation))


def text_colour(ax: Axes) -> ColorType:
    """The style's colour of text, legible on these axes."""
    return legible(ax, rcParams["text.color"])


def look_of(kind: type[Artist], look: Mapping[str, Any], allowed: tuple[str, ...] = (), **usual: Any) -> dict[str, Any]:
    """What an artist is drawn with: the `usual`, and instead of it what the caller's `look` says.

    Both by matplotlib's names or their short forms, and ``colour`` for ``color``. A TypeError names an option that
    neither has; `allowed` are those that are told when the artist is made, and not set.
    """
    given = normalize_kwargs({"color" if name == "colour" else name: value for name, value in look.items()}, kind)
    for name, value in given.items():
        if not hasattr(kind, f"set_{name}") and name not in allowed:
            raise TypeError(f"unknown option {name}={value!r}: neither of this function nor of a {kind.__name__}")
    return {**normalize_kwargs(usual, kind), **given}
