"""The course as two archives: ``make course``. The students' one has no solution in it, the teacher's has all."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).parents[1]
ASSIGNMENTS = ROOT / "notebooks" / "assignments"
MADE = shutil.ignore_patterns(
    "release", "submitted", "autograded", "feedback", "*.db", "*.csv", "__pycache__", ".ipynb*"
)


def main() -> None:
    """Release every assignment, build the wheel, and pack both."""
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder) / "course"
        shutil.copytree(ASSIGNMENTS, work, ignore=MADE)
        release(work)
        build = [sys.executable, "-m", "pip", "wheel", "--quiet", "--disable-pip-version-check", "--no-deps"]
        subprocess.run([*build, "--no-build-isolation", "--wheel-dir", folder, str(ROOT)], check=True)
        (wheel,) = Path(folder).glob("*.whl")
        for pack in (student_pack(work, wheel, ROOT), teacher_pack(work, wheel, ROOT)):
            print(f"{pack.name}: {pack.stat().st_size / 1e6:.1f} MB")


def release(work: Path) -> None:
    """Make the students' notebooks of a course, without solutions."""
    environment = {**os.environ, "JUPYTER_PLATFORM_DIRS": "1"}
    environment["PATH"] = f"{Path(sys.executable).parent}{os.pathsep}{environment.get('PATH', '')}"
    for source in sorted((work / "source").iterdir()):
        command = ["nbgrader", "generate_assignment", source.name, "--log-level=ERROR"]
        subprocess.run(command, cwd=work, env=environment, check=True)


def student_pack(work: Path, wheel: Path, out: Path) -> Path:
    """What students get: the released notebooks, the library, the page for the first hour."""
    files = {f"gearpair-course/{path.name}": path for path in sorted((work / "release").glob("*/*.ipynb"))}
    files |= {f"gearpair-course/{wheel.name}": wheel, "gearpair-course/FIRST-HOUR.md": ROOT / "book" / "first_hour.md"}
    return _packed(out / "gearpair-course-student.zip", files)


def teacher_pack(work: Path, wheel: Path, out: Path) -> Path:
    """What who teaches gets: the sources with solutions, hidden tests and rubrics, and what grades them."""
    kept = [*(work / "source").glob("*/*.ipynb"), *work.glob("*.py")]
    files = {f"gearpair-course-teacher/{path.relative_to(work).as_posix()}": path for path in sorted(kept)}
    files |= {f"gearpair-course-teacher/{wheel.name}": wheel}
    for name, path in (("TEACHING.md", "book/teaching.md"), ("requirements-teach.lock", "requirements-teach.lock")):
        files[f"gearpair-course-teacher/{name}"] = ROOT / path
    return _packed(out / "gearpair-course-teacher.zip", files)


def _packed(path: Path, files: dict[str, Path]) -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as pack:
        for name, file in files.items():
            pack.write(file, name)
    return path


if __name__ == "__main__":
    main()
