"""The written equations of a network read back by NumPy and SciPy: they give the solution and the cofactors that were written with them.

python3 tests/peers/equations.py EXAMPLE, where EXAMPLE is the compiled example `equations`. Without SciPy it says so.
"""
import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

try:
    import scipy.io
    import scipy.sparse.linalg
except ImportError:
    print("skipped: no scipy")
    print("0 passed, 0 failed, 1 skipped")
    sys.exit(0)

passed = failed = 0


def check(name, error, limit):
    global passed, failed
    good = bool(error <= limit)
    passed += good
    failed += not good
    print(f"{'ok' if good else 'FAILED'}  {name}: {error:.2e}, at most {limit:.0e}")


def compare(folder):
    load = lambda name: np.load(folder / f"{name}.npy")
    sparse = {name: scipy.io.mmread(folder / f"{name}.mtx").tocsr() for name in "ANS"}
    for name, matrix in sparse.items():
        check(f"{folder.name} {name}: Matrix Market and NumPy", abs(matrix.toarray() - load(name)).max(), 0.0)
    a, n, l, p = sparse["A"], sparse["N"], load("l"), load("p")
    size = np.sqrt(n.diagonal())
    apa = (a.T @ scipy.sparse.diags(p) @ a).toarray()
    check(f"{folder.name} N = A'PA", abs((apa - n.toarray()) / np.outer(size, size)).max(), 1e-12)
    # S by the dense Schur complement.
    kept = np.loadtxt(folder / "reduced.csv", skiprows=1, dtype=int)
    others = np.setdiff1d(np.arange(n.shape[0]), kept)
    full = n.toarray()
    s = full[np.ix_(kept, kept)] - full[np.ix_(kept, others)] @ np.linalg.solve(full[np.ix_(others, others)], full[np.ix_(others, kept)])
    check(f"{folder.name} S: Schur complement", abs((s - load("S")) / np.outer(size[kept], size[kept])).max(), 1e-11)
    # The solution by sparse least squares under the constraints: the normal equations, bordered and scaled.
    scaled = scipy.sparse.diags(1 / size)
    border = scipy.io.mmread(folder / "D.mtx").tocsr() @ scaled if (folder / "D.mtx").exists() else scipy.sparse.csr_matrix((0, len(size)))
    if border.shape[0]:
        border = scipy.sparse.diags(1 / scipy.sparse.linalg.norm(border, axis=1)) @ border
    bordered = scipy.sparse.bmat([[scaled @ n @ scaled, border.T], [border, None]] if border.shape[0] else [[scaled @ n @ scaled]]).tocsc()
    right = np.concatenate([(a.T @ (p * l)) / size, np.zeros(border.shape[0])])
    x = scipy.sparse.linalg.spsolve(bordered, right)[: len(size)] / size
    q = load("Qxx")
    sigma = np.sqrt(np.diag(q))
    # Solutions in their own standard errors; the condition of the scaled matrix is about 1e6.
    check(f"{folder.name} solution", abs((x - load("x")) / np.maximum(sigma, 1e-300)).max(), 1e-6)
    check(f"{folder.name} residuals", abs((a @ x - l - load("v")) * np.sqrt(p)).max(), 1e-6)
    inverse = np.linalg.inv(bordered.toarray())[: len(size), : len(size)] / np.outer(size, size)
    check(f"{folder.name} standard errors", abs(np.sqrt(np.diag(inverse)) / sigma - 1).max(), 1e-8)
    redundancy = np.sum(np.diag(load("Qvv")) * p)
    check(f"{folder.name} redundancy numbers", abs(redundancy - (a.shape[0] - a.shape[1] + border.shape[0])), 1e-6)
    names = [len(list(csv.reader(open(folder / file)))) - 1 for file in ("rows.csv", "columns.csv")]
    check(f"{folder.name} names", abs(np.subtract(names, a.shape)).max(), 0)


with tempfile.TemporaryDirectory() as there:
    subprocess.run([sys.argv[1], there], check=True)
    for case in ("control", "free"):
        compare(Path(there) / case)
print(f"{passed} passed, {failed} failed, 0 skipped")
sys.exit(failed > 0)
