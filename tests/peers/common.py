"""What the comparisons with other programs share: calling ours, judging, and what was skipped by name.

The first argument is the path to examples/interchange.
"""

import importlib
import json
import os
import shutil
import subprocess
import sys

import numpy as np

PROGRAM = sys.argv[1]
LIMIT = 1e-6
DATA = os.environ.get("SIGHTLINE_DATA") or os.path.join(os.path.dirname(__file__), "../../../shared/data")
passed, failed, skipped = [], [], []
random = np.random.default_rng(1971)


def ours(*words):
    done = subprocess.run([PROGRAM, *words], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    return json.loads(done.stdout)


def save(path, value):
    with open(path, "w") as file:
        json.dump(value, file)
    return path


def judge(name, theirs, here, limit=LIMIT):
    theirs, here = np.asarray(theirs, float), np.asarray(here, float)
    largest = np.abs(theirs - here).max() if theirs.shape == here.shape and theirs.size else np.inf
    (passed if largest <= limit else failed).append(name)
    print(f"{'ok' if largest <= limit else 'FAILED'}  {name}: {largest:.2e} px over {len(theirs)} points")


def part(name, module):
    """The package of a part; none where it is missing."""
    try:
        return importlib.import_module(module)
    except ImportError:
        skipped.append(name)
        print(f"skipped  {name}: no package {module}")
        return None


def tool(name, *places):
    """The path of a program of a part, beside this Python, on the path or in further places; none where it is missing."""
    beside = os.path.join(os.path.dirname(sys.executable), name)
    found = next((place for place in [beside, shutil.which(name), *places] if place and os.access(place, os.X_OK)), None)
    if not found:
        skipped.append(name)
        print(f"skipped  {name}: no such program")
    return found


def run(*words):
    """The output of a program that must succeed."""
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]}: {done.stderr.strip()[-300:]}")
    return done.stdout


def points(count=400, reach=0.42):
    """Points in front of a camera, far off its axis in both directions; x right, y down, z forwards."""
    z = random.uniform(0.5, 20, count)
    return np.column_stack([random.uniform(-reach, reach, count) * z, random.uniform(-reach, reach, count) * z, z])


def pixels(folder, camera, at):
    return ours("pixels", save(f"{folder}/camera.json", camera), save(f"{folder}/points.json", at.tolist()))


def moved(position, angles, at):
    """Points in the frame of a photo of the document, y down, z forwards."""
    (so, sp, sk), (co, cp, ck) = np.sin(angles), np.cos(angles)
    m = np.array([[cp * ck, so * sp * ck + co * sk, -co * sp * ck + so * sk], [-cp * sk, -so * sp * sk + co * ck, co * sp * sk + so * ck], [sp, -so * cp, co * cp]])
    return (at - position) @ (np.diag([1, -1, -1]) @ m).T


def opencv_camera():
    """A camera of the document with everything unequal."""
    u = random.uniform
    return dict(id="lens", width=1280, height=960, model="opencv", fx=u(850, 950), fy=u(860, 940), cx=u(600, 690), cy=u(440, 520),
                k1=u(-0.25, 0.1), k2=u(-0.05, 0.08), p1=u(1e-4, 2e-3), p2=u(-3e-3, -2e-4), k3=u(-0.02, 0.02))


def brown_camera():
    u = random.uniform
    return dict(id="lens", width=3000, height=2000, pixel_pitch=[0.0078, 0.0078], model="brown", c=u(23, 26), x0=u(0.05, 0.3), y0=u(-0.3, -0.05),
                k1=u(0.5e-4, 2e-4), k2=u(-3e-7, 1e-7), k3=0.0, p1=u(0.5e-5, 2e-5), p2=u(-3e-5, -1e-5), b1=u(1e-4, 5e-4), b2=u(-4e-4, -1e-4))


def every(parts):
    """Runs all parts, sums up and ends the program."""
    for one in parts:
        try:
            one()
        except Exception as error:  # A part that stops has failed; the others still say what they have to say.
            failed.append(one.__name__)
            print(f"FAILED  {one.__name__}: {type(error).__name__}: {error}")
    print(f"{len(passed)} passed, {len(failed)} failed, {len(skipped)} skipped")
    sys.exit(1 if failed else 0)
