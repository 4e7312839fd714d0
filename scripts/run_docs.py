"""Runs what the manual says: every sh and python block of the pages in docs/ that are named, in the order they stand, each
page in a folder of its own with `datasets` in it; compares C++ blocks with the file they are from. Checks all links, too.

  /usr/bin/python3 scripts/run_docs.py --program build/release/app/tcm-icp [--python build/release/python] [PAGE...]

A block that is not to be run has `<!-- not run: why -->` in the line above; a block from a file `<!-- file: PATH -->`.
"""

import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PAGES = ["tutorial", "scanning", "flagged_scans", "install", "library", "python", "faq"]
BLOCK = re.compile(r"(?:^<!-- (?P<mark>[^\n]*) -->\n)?^```(?P<language>\w*)\n(?P<text>.*?)^```$", re.M | re.S)
LINK = re.compile(r"\]\((?!https?:|mailto:|#)([^)#\s]+)(#[^)]*)?\)")


def blocks_of(page):
    text = page.read_text()
    for match in BLOCK.finditer(text):
        line = text.count("\n", 0, match.start("text")) + 1
        yield line, match["mark"] or "", match["language"], match["text"]


def heading_anchors(page):
    plain = re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)
    titles = re.findall(r"^#+ (.*)$", plain, re.M)
    return {re.sub(r"[\s]+", "-", re.sub(r"[^\w\s-]", "", title.lower()).strip()) for title in titles}


def check_links(page):
    for match in LINK.finditer(re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S)):
        target = (page.parent / match[1]).resolve()
        if not target.exists():
            yield f"{page.name}: no file {match[1]}"
        elif match[2] and target.suffix == ".md" and match[2][1:] not in heading_anchors(target):
            yield f"{page.name}: no heading {match[2]} in {match[1]}"


def check_reasons(page):
    header = (ROOT / "lib/include/tcm_icp/core/verdict.hpp").read_text()
    enum = header[header.index("enum class Reason {"):]
    for name in re.findall(r"^  (k\w+),", enum[:enum.index("};")], re.M):
        if f"`{name}`" not in page.read_text():
            yield f"{page.name}: nothing about the reason {name}"


def run(command, text, folder, environment):
    result = subprocess.run(command, input=text, cwd=folder, env=environment, text=True, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, check=False)
    return None if result.returncode == 0 else f"exit status {result.returncode}\n{result.stdout[-3000:]}"


def check_page(page, environment, with_python):
    failures = list(check_links(page))
    if page.stem == "flagged_scans":
        failures += check_reasons(page)
    blocks = list(blocks_of(page))
    python_lines = [line for line, mark, language, _ in blocks if language == "python" and not mark.startswith("not run")]
    script = ""
    with tempfile.TemporaryDirectory(prefix="tcm_icp_docs_") as folder:
        for name in ("datasets", "examples"):
            (Path(folder) / name).symlink_to(ROOT / name)
        for line, mark, language, text in blocks:
            place = f"{page.name}, line {line}"
            if mark.startswith("not run: ") or language in ("text", ""):
                continue
            problem = None
            if mark.startswith("file: "):
                if text.strip() not in (ROOT / mark[6:]).read_text():
                    problem = f"is not what stands in {mark[6:]}"
            elif language == "sh":
                problem = run(["bash", "-euo", "pipefail"], text, folder, environment)
            elif language == "python":
                # A block may use names of those before it: all of a page are one program, with the page's line numbers.
                script += "\n" * (line - 1 - script.count("\n")) + text
                if with_python and line == python_lines[-1]:
                    problem = run([sys.executable, "-"], script, folder, environment)
            else:
                problem = f"a block of '{language}' is neither run nor from a file"
            if problem:
                failures.append(f"{place}: {problem}")
    return failures


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=Path)
    parser.add_argument("--python", type=Path, help="folder of the Python module; without it its blocks are not run")
    parser.add_argument("pages", nargs="*", default=PAGES)
    options = parser.parse_args()
    environment = dict(os.environ, PATH=f"{options.program.resolve().parent}:{os.environ['PATH']}")
    if options.python:
        environment["PYTHONPATH"] = str(options.python.resolve())
    failures = []
    for name in options.pages:
        start = time.monotonic()
        found = check_page(ROOT / "docs" / f"{name}.md", environment, options.python is not None)
        print(f"{name}: {'FAILED' if found else 'as it says'}, {time.monotonic() - start:.1f} s", flush=True)
        failures += found
    print(*failures, sep="\n", file=sys.stderr)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
