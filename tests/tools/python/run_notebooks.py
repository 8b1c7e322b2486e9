"""run_notebooks.py FOLDER - runs the code of notebooks, cell by cell, and prints how each ended."""
import json
import sys
import traceback
from pathlib import Path

import matplotlib

matplotlib.use("agg")


def run(path):
    names = {}
    for cell in json.loads(path.read_text(encoding="utf-8"))["cells"]:
        if cell["cell_type"] == "code":
            code = compile("".join(cell["source"]), f"{path.name}, {cell['id']}", "exec")
            exec(code, names)  # noqa: S102


failed = 0
for each in sorted(Path(sys.argv[1]).glob("*.ipynb")):
    try:
        run(each)
        print(f"ok {each.stem}", flush=True)
    except Exception:
        traceback.print_exc(file=sys.stdout)
        print(f"not ok {each.stem}", flush=True)
        failed += 1
sys.exit(failed > 0)
