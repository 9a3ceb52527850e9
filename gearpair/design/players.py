"""A sound as a player in a page: the file inside it, silent until it is asked for, and what is heard in words."""

from __future__ import annotations

import base64
import io
from dataclasses import dataclass
from html import escape

from gearpair._checks import check_class, checked
from gearpair.design.sounds import Sound, write_wav


@checked
@dataclass(frozen=True)
class Player:
    """A sound that a notebook, and a page made from it, shows as a player.

    Parameters
    ----------
    heard : Sound
        Of a low rate, for the file stands in the page: 16 000 samples a second and 1.3 s make 56 kB.
    caption : str
        What it is of.
    told : str
        What is heard, for those who cannot or do not want to hear it.

    Notes
    -----
    It does not play by itself, and nothing is decoded before it is asked for.

    Examples
    --------
    >>> import numpy as np
    >>> tone = Sound(0.25 * np.sin(np.arange(8000) * 0.3), 8000, 100.0)
    >>> player = Player(tone, "A test", "A tone of 382 Hz.")
    >>> player
    A test: a sound of 1 s, peak 0.25 of 100 N. A tone of 382 Hz.
    >>> "autoplay" in player._repr_html_()
    False
    """

    heard: Sound
    caption: str
    told: str

    def __post_init__(self) -> None:
        check_class("heard", self.heard, Sound)

    def __repr__(self) -> str:
        """The text in place of the sound."""
        return f"{self.caption}: {self.heard}. {self.told}"

    def _repr_html_(self) -> str:
        file = io.BytesIO()
        write_wav(file, self.heard)
        data = base64.b64encode(file.getvalue()).decode("ascii")
        caption, told = escape(self.caption), escape(self.told)
        audio = f'<audio controls preload="none" aria-label="{caption}" src="data:audio/wav;base64,{data}"></audio>'
        return f'<figure class="sound">\n<figcaption>{caption}</figcaption>\n{audio}\n<p>{told}</p>\n</figure>'
