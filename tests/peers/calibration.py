"""Calibrations of a simulated board compared with OpenCV's and with a plain least-squares solution of the same equations by NumPy.

    python3 tests/peers/calibration.py PATH/TO/examples/adjust

Needs numpy and opencv-python-headless. The board's points are exact and its photos have noise of 0.1 px. Parameters are compared in our
standard errors, to 0.002; standard errors as quotients, to 0.2 %. OpenCV states standard errors for `calibrateCameraExtended` only; where its
iteration ends before it has arrived, NumPy's solution decides, and the distance is printed. Prints "N passed, M failed, K skipped".
"""

import json
import subprocess
import sys
import tempfile

try:
    import cv2
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    print("0 passed, 0 failed, 1 skipped")
    sys.exit(0)

PROGRAM = sys.argv[1]
SIGMA = 0.1
WIDTH, HEIGHT = 1600, 1200
NAMES = {
    "opencv": ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3"],
    "opencv_rational": ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2", "k3", "k4"],
    "opencv_fisheye": ["fx", "fy", "cx", "cy", "k1", "k2", "k3", "k4"],
}
TRUTH = {
    "opencv": [1500, 1502, 805, 596, -0.21, 0.09, 4e-4, -3e-4, -0.02],
    "opencv_rational": [1100, 1102, 805, 596, 0.32, 0.05, 4e-4, -3e-4, 0.004, 0.55],
    "opencv_fisheye": [620, 621, 805, 596, -0.02, 0.006, -0.003, 4e-4],
}
passed = failed = 0


def check(name, error, limit):
    global passed, failed
    good = bool(error <= limit)
    passed += good
    failed += not good
    print(f"{'ok' if good else 'FAILED'}  {name}: {error:.1e}, at most {limit:.0e}")


def project(model, interior, turn, shift, board):
    """Pixels with the centre of the first one at (0.5, 0.5)."""
    fx, fy, cx, cy, *d = interior
    k, d = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]]), np.array(d, float)
    if model == "opencv_fisheye":
        return cv2.fisheye.projectPoints(board.reshape(-1, 1, 3), turn, shift, k, d)[0].reshape(-1, 2)
    # OpenCV knows 4, 5 or 8 coefficients.
    d = np.concatenate([d, np.zeros(8 - len(d))]) if len(d) > 5 else d
    return cv2.projectPoints(board, turn, shift, k, d)[0].reshape(-1, 2)


def photos(model, random):
    """Board, poses and measured pixels of twenty photos that see the whole board."""
    x, y = np.meshgrid(np.arange(11.0), np.arange(9.0))
    # the board bends a little: its points are known
    board = np.column_stack([x.ravel(), y.ravel(), 0.15 * np.sin(x.ravel()) + 0.1 * np.cos(2 * y.ravel())]) * 30
    half = np.array([150, 120, 0.0])
    poses, pixels = [], []
    while len(poses) < 20:
        turn = random.uniform(-0.6, 0.6, 3) + [0, 0, np.pi / 2 * random.integers(4)]
        range_ = random.uniform(0.45, 1.1) * TRUTH[model][0] * 0.3
        aside = np.array([random.uniform(-0.45, 0.45) * range_, random.uniform(-0.35, 0.35) * range_, range_])
        shift = aside - cv2.Rodrigues(turn)[0] @ half
        seen = project(model, TRUTH[model], turn, shift, board)
        if np.all((seen > 2) & (seen < [WIDTH - 2, HEIGHT - 2])):
            poses.append((turn, shift))
            pixels.append(seen + random.normal(0, SIGMA, seen.shape))
    return board, poses, pixels


def ours(model, board, poses, pixels):
    names = NAMES[model]
    camera = dict(id="c", width=WIDTH, height=HEIGHT, model=model, free=names, **dict(zip(names, TRUTH[model])))
    rows, photos_ = [], []
    for k, ((turn, shift), seen) in enumerate(zip(poses, pixels)):
        r = cv2.Rodrigues(turn)[0]
        m = np.diag([1, -1, -1]) @ r
        angles = [np.arctan2(-m[2, 1], m[2, 2]), np.arcsin(m[2, 0]), np.arctan2(-m[1, 0], m[0, 0])]
        photos_.append(dict(id=f"f{k}", camera="c", position=(-r.T @ shift).tolist(), rotation=angles))
        rows += [dict(photo=f"f{k}", point=f"p{n}", u=u, v=v, sigma=SIGMA) for n, (u, v) in enumerate(seen)]
    document = dict(format="sightline", version=1, unit="mm", cameras=[camera], photos=photos_, observations=rows, datum=dict(kind="control"),
                    points=[dict(id=f"p{n}", xyz=at.tolist(), role="control", sigma=[0, 0, 0]) for n, at in enumerate(board)])
    with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
        json.dump(document, file)
        file.flush()
        done = subprocess.run([PROGRAM, file.name], capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(done.stderr.strip())
    found = json.loads(done.stdout)
    assert found["termination"] == "converged", found["termination"]
    camera = found["cameras"][0]
    return np.array([camera[n] for n in names]), np.array([camera["sigma"][n] for n in names]), found["sigma0"]


def plain(model, board, poses, pixels):
    """Least squares of every parameter and pose from the truth; standard errors from the Jacobian."""
    count = len(NAMES[model])
    measured = np.concatenate(pixels).ravel()
    size = np.array([1, 1, 1, 1] + [1e-3] * (count - 4) + [1e-3, 1e-3, 1e-3, 1, 1, 1] * len(poses))

    def residuals(z):
        z = z * size
        each = z[count:].reshape(-1, 6)
        return (np.concatenate([project(model, z[:count], p[:3], p[3:], board) for p in each]).ravel() - measured) / SIGMA

    def jacobian(z):
        # central differences, only of what a pose moves
        j = np.zeros((len(measured), len(z)))
        step = 1e-3
        for k in range(count):
            d = np.zeros(len(z))
            d[k] = step
            j[:, k] = (residuals(z + d) - residuals(z - d)) / (2 * step)
        rows = 2 * len(board)
        for photo in range(len(poses)):
            for m in range(6):
                k = count + 6 * photo + m
                ends = []
                for sign in [1, -1]:
                    moved = z.copy()
                    moved[k] += sign * step
                    moved = moved * size
                    p = moved[count + 6 * photo : count + 6 * photo + 6]
                    ends.append(project(model, moved[:count], p[:3], p[3:], board).ravel() / SIGMA)
                j[rows * photo : rows * (photo + 1), k] = (ends[0] - ends[1]) / (2 * step)
        return j

    start = np.concatenate([TRUTH[model], *[np.concatenate(p) for p in poses]]) / size
    z = start
    # Gauss's iteration: from here every step is short
    for _ in range(6):
        j, r = jacobian(z), residuals(z)
        z = z - np.linalg.lstsq(j, r, rcond=None)[0]
    j, r = jacobian(z), residuals(z)
    variance = r @ r / (len(r) - len(z))
    sigma = np.sqrt(np.diag(np.linalg.inv(j.T @ j)) * variance)[:count]
    return (z * size)[:count], sigma * size[:count], np.sqrt(variance)


def opencv(model, board, poses, pixels):
    """OpenCV's parameters, and its standard errors where it states some."""
    fx, fy, cx, cy, *d = TRUTH[model]
    # The centre of the first pixel is (0, 0) there; here it keeps ours, which shifts nothing but the principal point's name.
    k = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1.0]])
    objects = [board.astype(np.float32).reshape(-1, 1, 3) for _ in poses]
    images = [p.astype(np.float32).reshape(-1, 1, 2) for p in pixels]
    criteria = (cv2.TERM_CRITERIA_COUNT + cv2.TERM_CRITERIA_EPS, 1000, 1e-14)
    if model == "opencv_fisheye":
        # From OpenCV 5 on these are the module's own.
        names = ["CALIB_USE_INTRINSIC_GUESS", "CALIB_RECOMPUTE_EXTRINSIC", "CALIB_FIX_SKEW"]
        flags = sum(getattr(cv2.fisheye, name) if hasattr(cv2.fisheye, name) else getattr(cv2, name) for name in names)
        objects = [o.reshape(1, -1, 3).astype(np.float64) for o in objects]
        images = [i.reshape(1, -1, 2).astype(np.float64) for i in images]
        _, k, d, *_ = cv2.fisheye.calibrate(objects, images, (WIDTH, HEIGHT), k, np.array(d, float).reshape(4, 1), flags=flags, criteria=criteria)
        return np.array([k[0, 0], k[1, 1], k[0, 2], k[1, 2], *d.ravel()]), None
    flags = cv2.CALIB_USE_INTRINSIC_GUESS
    if model == "opencv_rational":
        flags |= cv2.CALIB_RATIONAL_MODEL | cv2.CALIB_FIX_K5 | cv2.CALIB_FIX_K6
        d = [*d, 0, 0]
    _, k, d, _, _, sigma, *_ = cv2.calibrateCameraExtended(objects, images, (WIDTH, HEIGHT), k, np.array(d, float), flags=flags, criteria=criteria)
    count = len(NAMES[model])
    return np.array([k[0, 0], k[1, 1], k[0, 2], k[1, 2], *d.ravel()])[:count], sigma.ravel()[:count]


for model in NAMES:
    board, poses, pixels = photos(model, np.random.default_rng(53))
    # float32 images as OpenCV takes them, so that all adjust the same numbers
    board, pixels = board.astype(np.float32).astype(float), [p.astype(np.float32).astype(float) for p in pixels]
    try:
        values, sigmas, sigma0 = ours(model, board, poses, pixels)
        oracle, oracle_sigmas, oracle_sigma0 = plain(model, board, poses, pixels)
        check(f"{model}: parameters against NumPy, standard errors", np.abs((values - oracle) / sigmas).max(), 0.002)
        check(f"{model}: standard errors against NumPy, quotient off 1", np.abs(sigmas / oracle_sigmas - 1).max(), 0.002)
        check(f"{model}: sigma0 against NumPy, quotient off 1", abs(sigma0 / oracle_sigma0 - 1), 1e-5)
        theirs, their_sigmas = opencv(model, board, poses, pixels)
        arrived = np.abs((theirs - oracle) / oracle_sigmas).max()
        print(f"    {model}: OpenCV ends {arrived:.1e} standard errors from NumPy's solution")
        if arrived < 0.002:
            check(f"{model}: parameters against OpenCV, standard errors", np.abs((values - theirs) / sigmas).max(), 0.002)
        if their_sigmas is not None:
            apart = np.abs(their_sigmas / oracle_sigmas - 1).max()
            print(f"    {model}: OpenCV's standard errors are at most {apart:.1e} off those of NumPy")
    except Exception as error:  # What stops has failed; the others still say what they have to say.
        failed += 1
        print(f"FAILED  {model}: {type(error).__name__}: {error}")
print(f"{passed} passed, {failed} failed, 0 skipped")
sys.exit(1 if failed else 0)
