# Copyright 2026 The percuss authors
# SPDX-License-Identifier: Apache-2.0
"""Runs the notebook of the paper, and looks at what it shows and at its numbers."""

import os
import sys
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

SOURCE = Path(os.environ["PERCUSS_SOURCE"])
CHECKS = """
ours = {(row.rod, row.model): (row.e, row[4]) for row in table_1.itertuples(index=False)}
# elastic: the paper's rods are these, whose material it does not say: 0.003 to both of its digits
assert all(abs(ours["al-rod", model][0] - its) < 0.003 for model, its in (("concurrent-fe", 0.631), ("table", 0.632))), ours
# that yields: 0.012 above the paper's, which another modulus or density explains; 0.002 from each other
assert all(abs(ours["al-rod-1", model][0] - 0.477) < 0.015 for model in ("concurrent-fe", "table")), ours
assert abs(ours["al-rod-1", "concurrent-fe"][0] - ours["al-rod-1", "table"][0]) < 0.003, ours
# e falls with speed, and lies below the elastic one where the rod yields: of 575 MPa above 0.3 m/s only
curves = {(curve.b, curve.contact_model.text): curve for curve in figure_1.curves}
weak, strong, elastic = (curves[key].restitution for key in (("al-rod-1", "auto"), ("al-rod-2", "auto"), ("al-rod-1", "hertz")))
assert (np.diff(weak) < 0.0).all() and (weak < elastic - 0.02).all(), weak - elastic
slow = curves["al-rod-2", "auto"].speed < 0.25
assert np.allclose(strong[slow], elastic[slow], atol=1e-3) and strong[-1] < elastic[-1] - 1e-3, strong - elastic
compact, rod, beam = (curve.restitution for curve in figure_2.curves)
assert compact.min() > 0.999 and (np.diff(rod) < 0.0).all() and (np.diff(beam) > 0.1).any() and (np.diff(beam) < -0.1).any()
# the paper's e, where 1 mm/s moves it by 0.02; its second blow after 4 ms, at 0.276 m/s its third after 5.2 ms
assert (abs(table_5["e"] - table_5["the paper, simulated"]) < 0.03).all(), table_5
assert [text.split(", ")[1][:3] for text in table_5["starts of sub-impacts, ms"]] in (["4.0", "3.9", "3.9"], ["4.0", "4.0", "4.0"]), table_5
assert table_5["starts of sub-impacts, ms"][0].split(", ")[2][:3] == "5.1", table_5
# 100 000 samples have 0.4466 and 0.2084: 4 standard errors of 5000
assert abs(e.mean - 0.4466) < 0.012 and abs(e.standard_deviation - 0.2084) < 0.006, (e.mean, e.standard_deviation)
print("checked")
"""


def kinds(cell: Any) -> set[str]:
    """In which forms the cell shows something."""
    return {kind for output in cell.outputs for kind in output.get("data", {})}


def main() -> int:
    notebook = nbformat.read(SOURCE / "client" / "examples" / "paper" / "paper.ipynb", as_version=4)
    nbformat.validate(notebook)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in cells), "what it showed once is not kept"
    notebook.cells.append(nbformat.v4.new_code_cell(CHECKS))
    NotebookClient(notebook, timeout=120, kernel_name="python3").execute()
    assert notebook.cells[-1].outputs[0].text == "checked\n", notebook.cells[-1].outputs
    pictures = [cell for cell in cells if cell.source.endswith(".plot()")]
    assert len(pictures) == 4 and all("image/png" in kinds(cell) for cell in pictures), [kinds(cell) for cell in pictures]
    (page,) = [cell for cell in cells if ".to_html(" in cell.source]
    assert "text/html" in kinds(page) and "<iframe" in page.outputs[0].data["text/html"], kinds(page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
