"""How a submission is run: the student's cells in a kernel, the tests apart from it.

nbgrader runs tests in the kernel of the student's code, where that code can replace whatever a test calls. Here the
kernel is asked for the answers only, as plain data, and the tests run on these in this process, where no code of a
student's ever runs. The text of a test comes from the gradebook, and the student's id from the submission's folder.
"""

import ast
import contextlib
import io
import logging
import re
import traceback
from pathlib import Path

from kernel_nursery import NurseryKernelManager, nursery
from nbclient.exceptions import CellTimeoutError, DeadKernelError
from nbformat.v4 import new_output
from nbgrader.api import Gradebook
from nbgrader.preprocessors import Execute, NbGraderPreprocessor

MIME = "application/vnd.gearpair.answers+json"
ASK = """
def _report(names=%r):
    from IPython.display import display
    from gearpair.teaching import report
    display({%r: report(names, globals())}, raw=True)
_report()
"""
FORGOTTEN = (
    "no id stands in the first code cell, so there is nothing to mark: write %r there, and grade once more with --force"
)
STOPPED = "not run: a cell before this one ended the kernel or could not be stopped, or two were stopped"
GONE = "the kernel died in this cell, or could not be stopped"
REFUSED = "is not graded, give the folder another name"
MOST_STOPS = 2


class GradeApart(Execute):
    """nbgrader's Execute, with the tests taken out of the student's kernel."""

    def __init__(self, *args, **kwargs):
        super().__init__(*args, **{"kernel_manager_class": NurseryKernelManager, **kwargs})
        nursery()  # imports while this process reads on

    def preprocess(self, nb, resources, *args, **kwargs):
        course = resources["nbgrader"]
        self.student_id = checked_folder(course["student"])
        self.typed = self.student_id
        self.stops = 0
        self.answers = {}
        with Gradebook(course["db_url"]) as gradebook:
            notebook = gradebook.find_notebook(course["notebook"], course["assignment"])
            graded = {cell.name for cell in notebook.grade_cells if cell.cell_type == "code"}
            cells = [cell for cell in notebook.source_cells if cell.name in graded and cell.locked]
            self.tests = {cell.name: cell.source for cell in cells}
        self.wanted = teaching_tools().answers_wanted(self.tests.values())
        nb, resources = super().preprocess(nb, resources, *args, **kwargs)
        self._mark(nb)
        return nb, resources

    def preprocess_cell(self, cell, resources, index):
        """Run a cell of the student's; in the place of a test, ask for the answers as they stand there."""
        name = test_name(cell)
        if cell.cell_type == "code" and name in self.tests:
            cell.source = ASK % ([*self.wanted, "student_id"], MIME)
            self._run(cell, resources, index)
            self.answers[name] = self._reported(cell)
            cell.source = self.tests[name]
        elif cell.cell_type == "code":
            self._run(cell, resources, index)
        return cell, resources

    def _run(self, cell, resources, index):
        if self.stops >= MOST_STOPS:
            cell.outputs = [new_output("error", ename="NotRun", evalue=STOPPED, traceback=[STOPPED])]
            return
        try:
            super().preprocess_cell(cell, resources, index)
        except (CellTimeoutError, DeadKernelError):  # it hears no interrupt, or is gone: what it said before counts
            cell.outputs.append(new_output("error", ename="KernelGone", evalue=GONE, traceback=[GONE]))
            self.stops = MOST_STOPS
            self.log.warning(GONE)
            return
        if any(output.get("ename") == "CellTimeoutError" for output in cell.outputs):
            self.stops += 1
            self.log.warning("a cell was stopped after %s s", self.timeout)

    def _reported(self, cell):
        read_report = teaching_tools().read_report
        texts = [output.data[MIME] for output in cell.outputs if MIME in output.get("data", {})]
        answers = read_report(texts[-1]) if texts and isinstance(texts[-1], str) else {}
        typed = answers.pop("student_id", None)
        if isinstance(typed, str) and not typed.strip():
            if self.typed:
                self.log.warning(FORGOTTEN, self.student_id)
            self.typed = ""
        elif isinstance(typed, str) and typed.strip().lower() not in (self.student_id.lower(), self.typed.lower()):
            self.typed = typed.strip()
            self.log.warning("the notebook of %s was worked on with the id %r", self.student_id, typed)
        return {name: answers.get(name) for name in self.wanted}

    def _mark(self, nb):
        cells = {test_name(cell): cell for cell in nb.cells if cell.cell_type == "code"}
        for name, outputs in run_tests(self.tests, self.answers, self.student_id):
            cells[name].outputs = outputs


class RememberHandedIn(NbGraderPreprocessor):
    """Writes into the graded notebook which one was handed in, so that the list of marks knows a later one."""

    def preprocess(self, nb, resources):
        from gearpair.teaching import gradebooks

        course = resources["nbgrader"]
        path = Path("submitted", course["student"], course["assignment"], f"{course['notebook']}.ipynb")
        nb.metadata[gradebooks.HANDED_IN] = gradebooks.digest(path)
        return nb, resources


class SentencesFirst(NbGraderPreprocessor):
    """On a page of feedback the sentences of a test stand above its code, where a student looks first."""

    def preprocess_cell(self, cell, resources, index):
        if cell.cell_type == "code" and cell.metadata.get("nbgrader", {}).get("grade"):
            said = "".join(output.text for output in cell.outputs if output.output_type == "stream")
            cell.source = "".join(f"# {line}\n" for line in said.splitlines()) + "\n" * bool(said) + cell.source
            cell.outputs = [output for output in cell.outputs if output.output_type != "stream"]
        return cell, resources


def checked_folder(student_id):
    """The folder's name, if it can be an id: otherwise every answer would be wrong, and nobody would know why."""
    from gearpair.teaching import check_student_id

    try:
        check_student_id(student_id)
    except ValueError as error:
        raise ValueError(f"submitted/{student_id} {REFUSED}: {error}") from None
    return student_id


NOISE = (
    "Attribute 'checksum' for cell",  # a test always differs from what was handed out, and is put back
    "There was an error processing assignment",  # the cause is told
    "Please see the the above traceback",
    "No notebooks found, did you forget",
)
CAUSES = {  # by what is found in what nbgrader says, in this order
    "NotJSONError": "the file is no notebook, but broken or empty: ask for it again",
    "ValidationError": "the file is no notebook that can be read: ask for it again",
    "No notebooks found": "no file has the assignment's name: rename the notebook that is there",
    "No notebooks were matched by": "the folder holds no notebook: not handed in",
}
of_whom = {"student": ""}  # whose notebook the log speaks of


def to_the_point(record):
    """Let every warning name its student; leave out what is said of every notebook, and the traceback of a sentence."""
    said = record.getMessage()
    named = re.findall(r"student with ID '(.+?)'", said) or re.findall(r"[\\/]submitted[\\/]([^\\/]+)[\\/]", said)
    if named:
        of_whom["student"] = named[-1]
    if record.levelno < logging.WARNING:
        return True
    if said.startswith(NOISE):
        return False
    if REFUSED in said:
        sentence = said[said.rindex("submitted/") :].strip()
    elif said.startswith("Skipping unknown notebook"):
        name = re.split(r"[\\/]", said)[-1]
        sentence = f"{name!r} is not read, for its name is not that of the assignment: rename it if it is to be graded"
    else:
        last = said.strip().splitlines()[-1] if said.startswith("Traceback") else said
        sentence = next((cause for found, cause in CAUSES.items() if found in said), last)
    who = of_whom["student"]
    itself = not who or sentence.startswith((f"submitted/{who} ", f"the notebook of {who} "))
    record.msg, record.args = sentence if itself else f"{who}: {sentence}", ()
    return True


def test_name(cell):
    """The name under which the gradebook may have a cell."""
    return cell.metadata.get("nbgrader", {}).get("grade_id")


def teaching_tools():
    """Imported where it is needed, since most of nbgrader's commands run no test and need not wait for it."""
    from gearpair import teaching

    return teaching


def given(student_id):
    """What every test has beside the answers."""
    return teaching_tools().given_to_tests(student_id)


def run_tests(tests, answers, student_id):
    """Run the tests that have answers, in the order of the assignment, wherever the student moved them.

    Yields the name and the outputs of each; they share their variables.
    """
    always, variables = given(student_id), {}
    for name, test in tests.items():
        if name in answers:
            variables |= {**answers[name], **always}
            yield name, run_test(test, variables)


def run_test(test, variables):
    """Run a test; its outputs as a notebook has them: what it printed, and the value of its last line."""
    printed, tree = io.StringIO(), ast.parse(test)
    last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
    outputs = []
    with contextlib.redirect_stdout(printed):
        try:
            exec(compile(tree, "test", "exec"), variables)
            value = eval(compile(last, "test", "eval"), variables) if last else None
            if value is not None:
                outputs.append(new_output("execute_result", {"text/plain": repr(value)}, execution_count=1))
        except Exception as error:
            outputs.append(
                new_output(
                    "error",
                    ename=type(error).__name__,
                    evalue=str(error),
                    traceback=traceback.format_exception_only(error),
                )
            )
    if printed.getvalue():
        outputs.insert(0, new_output("stream", name="stdout", text=printed.getvalue()))
    return outputs
