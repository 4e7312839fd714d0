"""A table as CSV, Markdown and LaTeX."""

import csv

LATEX = {"&": r"\&", "%": r"\%", "_": r"\_", "#": r"\#", "$": r"\$", "{": r"\{", "}": r"\}", "~": r"\textasciitilde{}",
         "^": r"\textasciicircum{}", "\\": r"\textbackslash{}"}


def latex_text(text):
    return "".join(LATEX.get(c, c) for c in str(text))


def markdown(header, rows):
    line = lambda cells: "| " + " | ".join(str(c).replace("|", "/").replace("\n", " ") for c in cells) + " |"
    return "\n".join([line(header), "|" + "---|" * len(header), *map(line, rows)]) + "\n"


def latex(header, rows, caption, label):
    line = lambda cells: " & ".join(map(latex_text, cells)) + r" \\"
    columns = "l" + "|p{0.2\\linewidth}" * (len(header) - 1)
    return "\n".join([r"\begin{table}[h]", r"\centering\footnotesize", rf"\caption{{{latex_text(caption)}}}",
                      rf"\label{{{label}}}", rf"\begin{{tabular}}{{{columns}}}", line(header), r"\hline",
                      *map(line, rows), r"\end{tabular}", r"\end{table}", ""])


def write_table(folder, name, header, rows, caption, notes=""):
    """NAME.csv, NAME.md and NAME.tex in a folder."""
    with open(folder / f"{name}.csv", "w", newline="", encoding="utf-8") as f:
        csv.writer(f).writerows([header, *rows])
    (folder / f"{name}.md").write_text(f"{caption}\n\n{markdown(header, rows)}" + (f"\n{notes}\n" if notes else ""),
                                       encoding="utf-8")
    (folder / f"{name}.tex").write_text(latex(header, rows, f"{caption}. {notes}" if notes else caption, f"tab:{name}"),
                                        encoding="utf-8")
