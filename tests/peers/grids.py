"""Boards of circles named by us and by OpenCV's findCirclesGrid: on seeded rendered views and on OpenCV's photos.

    python3 tests/peers/grids.py PATH/TO/examples/grids [VIEWS]

Needs numpy and opencv-python-headless. OpenCV gets a detector of dots whose limits of area suit every view, and both of its ways (one after the
other, the first that succeeds counts). A naming is right if every dot named lies within 3 px of its place. Ours must never be wrong, and name
every view that OpenCV names rightly. Prints the counts of both and "N passed, M failed, K skipped".
"""

import json
import os
import subprocess
import sys
import tempfile
import time

try:
    import cv2
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    print("0 passed, 0 failed, 1 skipped")
    sys.exit(0)

PROGRAM = sys.argv[1]
VIEWS = int(sys.argv[2]) if len(sys.argv) > 2 else 30
NEAR = 3.0
DATA = os.environ.get("SIGHTLINE_DATA") or os.path.join(os.path.dirname(__file__), "../../../shared/data")
passed = failed = skipped = 0


def check(name, good):
    global passed, failed
    passed += good
    failed += not good
    print(f"{'ok' if good else 'FAILED'}  {name}")


def ours(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return json.loads(done.stdout)


def detector():
    parameters = cv2.SimpleBlobDetector_Params()
    parameters.minArea, parameters.maxArea = 20, 20000
    parameters.minDistBetweenBlobs = 5
    # what a dot becomes at 60 degrees
    parameters.minInertiaRatio = 0.05
    return cv2.SimpleBlobDetector_create(parameters)


def theirs(picture, rows, columns, kind):
    """Pixels of the dots in OpenCV's order, row by row; none where it finds no board."""
    kinds = cv2.CALIB_CB_ASYMMETRIC_GRID if kind == "asymmetric" else cv2.CALIB_CB_SYMMETRIC_GRID
    for flags in [kinds, kinds | cv2.CALIB_CB_CLUSTERING]:
        found, centres = cv2.findCirclesGrid(picture, (columns, rows), flags=flags, blobDetector=detector())
        if found:
            # The centre of the first pixel is (0, 0) there.
            return [tuple(c) for c in np.reshape(centres, (-1, 2)) + 0.5]
    return None


def off(named, truth):
    """Largest distance of a named dot from its place; infinite where it has none."""
    apart = [np.inf if place is None else np.hypot(*np.subtract(dot, place)) for dot, place in zip(named, truth) if dot is not None]
    return max(apart, default=None)


def tally(named, truth):
    """1 right, 0 not named, -1 wrong."""
    largest = off(named, truth) if named else None
    return 0 if largest is None else 1 if largest <= NEAR else -1


def views(aside):
    counts = {whole: [[0, 0, 0], [0, 0, 0], 0] for whole in [True, False]}
    missed, times, dots, complete = [], 0.0, 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for view in ours("views", folder, str(VIEWS), str(aside)):
            picture = cv2.imread(f"{folder}/{view['file']}", cv2.IMREAD_GRAYSCALE)
            began = time.time()
            they = tally(theirs(picture, 13, 7, "asymmetric"), view["truth"])
            times += time.time() - began
            # dots cut by the border have no truth; those that have one decide
            known = [dot if place is not None else None for dot, place in zip(view["named"], view["truth"])]
            we = tally(known, view["truth"])
            here, there, _ = counts[view["whole"]]
            here[1 - we] += 1
            there[1 - they] += 1
            counts[view["whole"]][2] += 1
            if they == 1 and we != 1:
                missed.append(view["file"])
            if we == 1:
                dots += sum(place is not None for place in view["truth"])
                complete += sum(dot is not None for dot in known)
    for whole, (here, there, all_) in counts.items():
        said = "whole" if whole else "cut by the border"
        print(f"    {all_} views {said}, aside {aside}: ours {here[0]} right, {here[1]} not named, {here[2]} wrong; OpenCV {there[0]} right, {there[1]} not named, {there[2]} wrong")
    print(f"    of the dots in views that are named {complete} of {dots} are named; OpenCV takes {1000 * times / VIEWS:.0f} ms a view")
    wrong = sum(here[2] for here, _, _ in counts.values())
    check(f"rendered views aside {aside}: none of ours wrong", wrong == 0)
    check(f"rendered views aside {aside}: every one that OpenCV names, {missed}", not missed)
    if counts[True][2]:
        check(f"rendered views aside {aside}: every whole board named", counts[True][0][0] == counts[True][2])


def photos():
    global skipped
    path = f"{DATA}/photos/grids.json"
    if not os.path.exists(path):
        skipped += 1
        print("skipped  photos: no data")
        return
    both = [0, 0]
    grids = json.load(open(path))
    # Of this photo there is no list: OpenCV's own centres are.
    dense = theirs(cv2.imread(f"{DATA}/photos/circlesgrid.png", cv2.IMREAD_GRAYSCALE), 6, 6, "symmetric")
    check("photo circlesgrid.png: OpenCV names it", dense is not None)
    grids["circlesgrid.png"] = dict(grid=[6, 6], centres=dense or [])
    for name, entry in grids.items():
        columns, rows = entry["grid"]
        kind = "asymmetric" if name.startswith("a") else "symmetric"
        picture = cv2.imread(f"{DATA}/photos/{name}", cv2.IMREAD_GRAYSCALE)
        they = theirs(picture, rows, columns, kind)
        here = ours("photo", f"{DATA}/photos/{name}", str(rows), str(columns), kind)
        # boards that look the same when turned: for the turn that fits best
        turns = [np.arange(rows * columns), np.arange(rows * columns)[::-1]]
        if kind == "symmetric" and rows == columns:
            square = np.arange(rows * columns).reshape(rows, columns)
            turns += [np.rot90(square).ravel(), np.rot90(square, 3).ravel()]
        if kind == "asymmetric":
            turns = turns[:1] if rows % 2 else turns
        named = here["named"]
        best = min((off([named[k] for k in turn], entry["centres"]) or np.inf) for turn in turns)
        right = best <= NEAR
        count = sum(dot is not None for dot in named)
        they_right = they is not None and min(off([they[k] for k in turn], entry["centres"]) for turn in turns) <= NEAR
        both[0] += right
        both[1] += they_right
        print(f"    {name}: ours {count} of {rows * columns} dots, at most {best:.2f} px from OpenCV's list; OpenCV {'names it' if they_right else 'names nothing' if they is None else 'names it otherwise'}")
        check(f"photo {name}", bool(right) and count >= 0.97 * rows * columns)
    print(f"    {len(grids)} photos: ours {both[0]}, OpenCV {both[1]} named rightly")


for run in [lambda: views(0.1), lambda: views(0.5), lambda: views(1.0), photos]:
    try:
        run()
    except Exception as error:  # What stops has failed; the others still say what they have to say.
        failed += 1
        print(f"FAILED  {type(error).__name__}: {error}")
print(f"{passed} passed, {failed} failed, {skipped} skipped")
sys.exit(1 if failed else 0)
