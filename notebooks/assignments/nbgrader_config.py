"""The course, for nbgrader: run its commands in this directory (see the book's page for teachers)."""

import logging
import sys
import warnings
from pathlib import Path

import zmq

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from grading_apart import GradeApart, RememberHandedIn, SentencesFirst, to_the_point  # noqa: E402
from nbgrader.converters.autograde import Autograde  # noqa: E402
from nbgrader.converters.generate_feedback import GenerateFeedback  # noqa: E402
from nbgrader.preprocessors import Execute  # noqa: E402
from sqlalchemy.exc import SAWarning  # noqa: E402

c = get_config()  # noqa: F821  (traitlets puts it here)
c.CourseDirectory.root = str(HERE)
c.CourseDirectory.course_id = "gearpair"
c.CourseDirectory.ignore = [".ipynb_checkpoints", "*.pyc", "__pycache__"]
c.ClearSolutions.code_stub = {"python": "# your code here"}
c.ClearSolutions.text_stub = "*Your answer here.*"
c.IncludeHeaderFooter.header = ""
c.OverwriteCells.add_missing_cells = True  # a test that was deleted is put back

# What is said of every notebook would hide what a teacher should see.
logging.getLogger("AutogradeApp").addFilter(to_the_point)
warnings.filterwarnings("ignore", category=SAWarning, module="nbgrader")
c.KernelManager.transport_encryption = "auto" if zmq.has("curve") else "disabled"

# The student's cells run in a kernel of their own, the tests apart from it.
c.Autograde.autograde_preprocessors = [
    *(GradeApart if each is Execute else each for each in Autograde.autograde_preprocessors.default()),
    RememberHandedIn,
]
c.GenerateFeedback.preprocessors = [*GenerateFeedback.preprocessors.default(), SentencesFirst]
c.GradeApart.timeout = 60  # seconds for one cell; after two cells that were stopped, the rest is not run
c.GradeApart.iopub_timeout = 20  # seconds for what a cell printed to arrive; a machine may be busy
c.GradeApart.shutdown_kernel = "immediate"  # nothing of a kernel's is wanted after its last cell
