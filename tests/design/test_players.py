"""A player: the file in the page is the sound, nothing plays by itself, and the words are there."""

import base64
import io
import re

import nbformat
import numpy as np
import pytest
from scipy.io import wavfile

from gearpair.design import Player, Sound
from tools.accept import stable_notebook

SOUND = Sound(0.5 * np.sin(2.0 * np.pi * 440.0 * np.arange(16_000) / 16_000), 16_000, 100.0)


def test_the_file_in_the_page_is_the_sound() -> None:
    html = Player(SOUND, "One <tone>", "A tone of 440 Hz.")._repr_html_()
    (data,) = re.findall(r'src="data:audio/wav;base64,([^"]*)"', html)
    rate, samples = wavfile.read(io.BytesIO(base64.b64decode(data)))
    assert rate == 16_000 and samples / 32767.0 == pytest.approx(SOUND.samples, abs=1e-4)
    assert "autoplay" not in html and 'preload="none"' in html and "<audio controls" in html
    assert "<figcaption>One &lt;tone&gt;</figcaption>" in html and "<p>A tone of 440 Hz.</p>" in html
    assert len(html) < 44_000


def test_a_stored_notebook_keeps_the_words_and_not_the_file(tmp_path) -> None:
    player = Player(SOUND, "One tone", "A tone of 440 Hz.")
    data = {"text/plain": repr(player), "text/html": player._repr_html_()}
    output = nbformat.v4.new_output("display_data", data)
    notebook = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1", outputs=[output])])
    nbformat.write(notebook, tmp_path / "a.ipynb")
    stored = stable_notebook(tmp_path / "a.ipynb", notebook)
    assert stored.cells[0].outputs[0].data == {"text/plain": repr(player)}


def test_bad_input() -> None:
    with pytest.raises((TypeError, ValueError), match="heard must be a Sound"):
        Player("a sound", "One", "A tone.")
