"""A formula as a picture that needs no script and no network: for pages that are printed."""

import io

import matplotlib as mpl
from matplotlib import mathtext
from matplotlib.font_manager import FontProperties


def formula_svg(latex: str, size: float = 11.0) -> str | None:
    """A formula as SVG, to be put into a page; None where matplotlib's mathtext cannot set it.

    Parameters
    ----------
    latex : str
        Without dollar signs.
    size : float
        Of the letters, in points.

    Examples
    --------
    >>> formula_svg(r"\\omega_n = \\sqrt{k_m/m_e}").startswith("<svg")
    True
    >>> formula_svg(r"\\nosuch") is None
    True
    """
    drawn = io.BytesIO()
    try:
        with mpl.rc_context({"mathtext.fontset": "cm", "svg.hashsalt": latex}):
            depth = mathtext.math_to_image(f"${latex}$", drawn, prop=FontProperties(size=size), format="svg")
    except ValueError:
        return None
    svg = drawn.getvalue().decode()
    svg = svg[svg.index("<svg") :]
    return svg.replace("<svg ", f'<svg style="vertical-align:-{depth:.1f}pt" role="img" ', 1).replace("\n", "")
