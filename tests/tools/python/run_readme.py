"""run_readme.py TREE - runs the code of the package's README, block by block, from the tree."""
import os
import re
import sys
import tempfile
import traceback
from pathlib import Path

tree = Path(sys.argv[1]).resolve()
text = (tree / "tools" / "python" / "README.md").read_text(encoding="utf-8")
names = {}
failed = 0
with tempfile.TemporaryDirectory() as folder:
    os.chdir(folder)
    os.symlink(tree / "scenes", "scenes")
    for number, block in enumerate(re.findall(r"```python\n(.*?)```", text, re.S), 1):
        try:
            exec(compile(block, f"README.md, block {number}", "exec"), names)  # noqa: S102
            print(f"ok readme_block_{number}", flush=True)
        except Exception:
            traceback.print_exc(file=sys.stdout)
            print(f"not ok readme_block_{number}", flush=True)
            failed += 1
    os.chdir("/")
sys.exit(failed > 0)
