"""Figures of tests and of doctests alike: drawn without a window, and closed after each."""

import matplotlib
import pytest
from matplotlib import pyplot as plt

matplotlib.use("Agg")


@pytest.fixture(autouse=True)
def closed_figures():
    """Figures that an example opens are closed behind it."""
    yield
    plt.close("all")
