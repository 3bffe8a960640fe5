"""Files of other programs compared with these programs themselves: every camera images random points in their model and in ours.

    python3 tests/peers/interchange.py PATH/TO/examples/interchange

Needs numpy; opencv-python-headless, pycolmap, mrcal and PyYAML each for its own part, which is skipped by name where the package is missing.
Prints a line a comparison and "N passed, M failed, K skipped"; the exit code says whether anything failed.
"""

import os
import tempfile

import numpy as np

from common import DATA, LIMIT, brown_camera, every, judge, moved, opencv_camera, ours, part, passed, pixels, points, random, save, skipped


def of_opencv(cv2, path, at):
    file = cv2.FileStorage(path, cv2.FILE_STORAGE_READ)
    k, d = file.getNode("camera_matrix").mat(), file.getNode("distortion_coefficients").mat()
    # The centre of the first pixel is (0, 0) there.
    return cv2.projectPoints(at, np.zeros(3), np.zeros(3), k, d)[0][:, 0] + 0.5


def opencv():
    cv2 = part("opencv", "cv2")
    if not cv2:
        return
    for ending in ["yml", "xml", "json"]:
        for count in [4, 5, 8]:
            with tempfile.TemporaryDirectory() as folder:
                path, u = f"{folder}/c.{ending}", random.uniform
                k = np.array([[u(850, 950), 0, u(600, 690)], [0, u(860, 940), u(440, 520)], [0, 0, 1]])
                # Eight coefficients whose denominator is 1: the engine's model exactly.
                d = np.concatenate([[u(-0.2, 0.1), u(-0.05, 0.05), u(1e-4, 2e-3), u(-3e-3, -2e-4), u(-0.02, 0.02)], np.zeros(3)])[:count]
                file = cv2.FileStorage(path, cv2.FILE_STORAGE_WRITE)
                file.write("image_width", 1280), file.write("image_height", 960)
                file.write("camera_matrix", k), file.write("distortion_coefficients", d.reshape(-1, 1))
                file.release()
                read = ours("read", "auto", path)
                assert read["format"] == "opencv", read
                at = points()
                judge(f"opencv {ending} of OpenCV with {count} coefficients", of_opencv(cv2, path, at), pixels(folder, read["cameras"][0]["camera"], at))
    for make in [opencv_camera, brown_camera]:
        with tempfile.TemporaryDirectory() as folder:
            camera, at = make(), points()
            conversion = ours("write", "opencv", save(f"{folder}/lens.json", camera), folder)
            difference = of_opencv(cv2, f"{folder}/camera.yml", at)
            # A conversion is as far off as it says, over the picture.
            here = np.array([p or [np.nan, np.nan] for p in pixels(folder, camera, at)])
            inside = np.all((here >= 0) & (here <= [camera["width"], camera["height"]]), axis=1)
            limit = LIMIT if conversion is None else conversion["max_px"] * 1.01 + 1e-6
            judge(f"opencv written of {camera['model']}", difference[inside], here[inside], limit)
    rational_and_fisheye(cv2)
    converted(cv2)


def rational_and_fisheye(cv2):
    """Eight coefficients and the fisheye, written by OpenCV and by us: the engine's models exactly, to 1e-9 px."""
    for model in ["opencv_rational", "opencv_fisheye"]:
        with tempfile.TemporaryDirectory() as folder:
            u, path = random.uniform, f"{folder}/theirs.yml"
            k = np.array([[u(850, 950), 0, u(600, 690)], [0, u(860, 940), u(440, 520)], [0, 0, 1]])
            is_fisheye = model == "opencv_fisheye"
            d = [u(-0.02, 0.02), u(-5e-3, 5e-3), u(-1e-3, 1e-3), u(-1e-4, 1e-4)] if is_fisheye else [u(0.2, 0.4), u(0.05, 0.1), u(1e-4, 1e-3), u(-1e-3, -1e-4), u(0, 0.02), u(0.3, 0.5), u(0.05, 0.1), u(0, 0.02)]
            d = np.array(d).reshape(-1, 1)
            file = cv2.FileStorage(path, cv2.FILE_STORAGE_WRITE)
            file.write("image_width", 1280), file.write("image_height", 960)
            if is_fisheye:
                file.write("fisheye_model", 1)
            file.write("camera_matrix", k), file.write("distortion_coefficients", d)
            file.release()
            at = points()
            def project(k, d):
                if is_fisheye:
                    return cv2.fisheye.projectPoints(at.reshape(-1, 1, 3), np.zeros(3), np.zeros(3), k, d)[0].reshape(-1, 2) + 0.5
                return cv2.projectPoints(at, np.zeros(3), np.zeros(3), k, d)[0][:, 0] + 0.5
            read = ours("read", "opencv", path)["cameras"][0]
            assert read["camera"]["model"] == model and read.get("conversion") is None, read
            judge(f"{model} of OpenCV", project(k, d), pixels(folder, read["camera"], at), 1e-9)
            assert ours("write", "opencv", save(f"{folder}/lens.json", read["camera"]), folder) is None
            file = cv2.FileStorage(f"{folder}/camera.yml", cv2.FILE_STORAGE_READ)
            judge(f"{model} written", project(file.getNode("camera_matrix").mat(), file.getNode("distortion_coefficients").mat()), pixels(folder, read["camera"], at), 1e-9)


def converted(cv2):
    """Twelve and fourteen coefficients: the difference is the one that is stated."""
    for name, d in [("12", [-0.1, 0.02, 4e-4, -3e-4, 0, 0, 0, 0, 2e-4, -1e-4, 1e-4, 3e-4]),
                    ("14", [-0.1, 0.02, 4e-4, -3e-4, 0, 0, 0, 0, 2e-4, -1e-4, 1e-4, 3e-4, 0.002, -0.001])]:
        with tempfile.TemporaryDirectory() as folder:
            path = f"{folder}/c.yml"
            k = np.array([[903.0, 0, 641.5], [0, 911.0, 472.25], [0, 0, 1]])
            file = cv2.FileStorage(path, cv2.FILE_STORAGE_WRITE)
            file.write("image_width", 1280), file.write("image_height", 960)
            file.write("camera_matrix", k), file.write("distortion_coefficients", np.array(d).reshape(-1, 1))
            file.release()
            read, at = ours("read", "opencv", path)["cameras"][0], points(2000, 0.7)
            theirs = of_opencv(cv2, path, at)
            inside = np.all((theirs >= 0) & (theirs <= [1280, 960]), axis=1)
            here = np.array([p or [np.nan, np.nan] for p in pixels(folder, read["camera"], at)])
            print(f"    stated: {read['conversion']['max_px']:.4f} px at most, {read['conversion']['rms_px']:.4f} px rms to {read['conversion']['to']}")
            judge(f"opencv with {name} coefficients, converted", theirs[inside], here[inside], read["conversion"]["max_px"] * 1.01 + 1e-6)


def ros_and_kalibr():
    """By OpenCV's projection of what PyYAML reads."""
    cv2, yaml = part("ros and kalibr", "cv2"), part("ros and kalibr", "yaml")
    if not cv2 or not yaml:
        return
    with tempfile.TemporaryDirectory() as folder:
        camera, at = opencv_camera(), points()
        assert ours("write", "ros", save(f"{folder}/lens.json", camera), folder) is None
        info = yaml.safe_load(open(f"{folder}/camera_info.yaml"))
        assert info["distortion_model"] == "plumb_bob", info
        k, d = np.reshape(info["camera_matrix"]["data"], (3, 3)), np.array(info["distortion_coefficients"]["data"])
        judge("ros written", cv2.projectPoints(at, np.zeros(3), np.zeros(3), k, d)[0][:, 0] + 0.5, pixels(folder, camera, at))
        read = ours("read", "auto", f"{folder}/camera_info.yaml")
        assert read["format"] == "ros", read
        judge("ros read", pixels(folder, read["cameras"][0]["camera"], at), pixels(folder, camera, at))
        camera["k3"] = 0.0
        assert ours("write", "kalibr", save(f"{folder}/lens.json", camera), folder) is None
        chain = yaml.safe_load(open(f"{folder}/camchain.yaml"))["cam0"]
        fx, fy, cx, cy = chain["intrinsics"]
        k, d = np.array([[fx, 0, cx], [0, fy, cy], [0, 0, 1]]), np.array(chain["distortion_coeffs"])
        judge("kalibr written", cv2.projectPoints(at, np.zeros(3), np.zeros(3), k, d)[0][:, 0] + 0.5, pixels(folder, camera, at))
        read = ours("read", "auto", f"{folder}/camchain.yaml")
        assert read["format"] == "kalibr", read
        judge("kalibr read", pixels(folder, read["cameras"][0]["camera"], at), pixels(folder, camera, at))


def mrcal():
    peer = part("mrcal", "mrcal")
    if not peer:
        return
    with tempfile.TemporaryDirectory() as folder:
        u = random.uniform
        for count in [4, 5]:
            values = np.concatenate([[u(850, 950), u(860, 940), u(600, 690), u(440, 520), u(-0.2, 0.1), u(-0.05, 0.05), u(1e-4, 2e-3), u(-3e-3, -2e-4)],
                                     [u(-0.02, 0.02)][:count - 4]])
            turn = np.array([0.3, -0.2, 0.5, 1.0, -2.0, 3.0])
            model = peer.cameramodel(intrinsics=(f"LENSMODEL_OPENCV{count}", values), imagersize=(1280, 960))
            (model.rt_cam_ref if hasattr(model, "rt_cam_ref") else model.extrinsics_rt_fromref)(turn)
            model.write(f"{folder}/c.cameramodel")
            read, at = ours("read", "auto", f"{folder}/c.cameramodel"), points()
            assert read["format"] == "mrcal", read
            judge(f"mrcal OPENCV{count} of mrcal", peer.project(at, *model.intrinsics()) + 0.5, pixels(folder, read["cameras"][0]["camera"], at))
            # The pose: points of the reference into the camera.
            found = read["cameras"][0]
            from_ref = peer.transform_point_rt(turn, at)
            judge(f"mrcal pose with OPENCV{count}", from_ref, moved(found["position"], found["rotation"], at), 1e-9)
        camera = opencv_camera()
        assert ours("write", "mrcal", save(f"{folder}/lens.json", camera), folder) is None
        model = peer.cameramodel(f"{folder}/camera.cameramodel")
        judge("mrcal written", peer.project(at, *model.intrinsics()) + 0.5, pixels(folder, camera, at))
        for name in ["cam0.opencv8.cameramodel", "overpass-opencv8.cameramodel"]:
            path = f"{DATA}/interchange/{name}"
            if not os.path.exists(path):
                skipped.append(name)
                continue
            model = peer.cameramodel(path)
            read = ours("read", "mrcal", path)["cameras"][0]
            assert read["camera"]["model"] == "opencv_rational" and read.get("conversion") is None, read
            width, height = model.imagersize()
            region = np.array(read.get("region") or [[0, 0], [width, 0], [width, height], [0, height]])
            grid = np.array([[x, y] for x in np.linspace(region[:, 0].min(), region[:, 0].max(), 40) for y in np.linspace(region[:, 1].min(), region[:, 1].max(), 40)])
            at = peer.unproject(grid - 0.5, *model.intrinsics())
            judge(f"mrcal {name}", peer.project(at, *model.intrinsics()) + 0.5, pixels(folder, read["camera"], at), 1e-9)

    uncertainty(peer)


def uncertainty(peer):
    """Projection uncertainty of mrcal's own calibration, from its board observations: standard errors of directions within 2 % everywhere.

    The board is held as mrcal found it and without mrcal's regularisation, so that both solve the same equations.
    """
    path = f"{DATA}/interchange/overpass-opencv8.cameramodel"
    if not part("mrcal projection uncertainty", "scipy") or not os.path.exists(path):
        return
    inputs = peer.cameramodel(path).optimization_inputs()
    inputs.update(do_optimize_calobject_warp=False, do_apply_regularization=False, do_apply_outlier_rejection=False, verbose=False)
    peer.optimize(**inputs)
    model = peer.cameramodel(optimization_inputs=inputs, icam_intrinsics=0)
    observed = inputs["observations_board"]
    frames, rows, columns = observed.shape[:3]
    board = peer.ref_calibration_object(columns, rows, inputs["calibration_object_spacing"], calobject_warp=inputs["calobject_warp"]).reshape(-1, 3)
    fx, fy, cx, cy, *coefficients = model.intrinsics()[1]
    width, height = (int(size) for size in model.imagersize())
    names = ["k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"]
    camera = dict(id="c", width=width, height=height, model="opencv_rational", fx=fx, fy=fy, cx=cx + 0.5, cy=cy + 0.5, free=["fx", "fy", "cx", "cy", *names], **dict(zip(names, coefficients)))
    photos, observations = [], []
    for k, (frame, pose) in enumerate(zip(observed.reshape(frames, -1, 3), inputs["rt_ref_frame"])):
        turn = peer.R_from_r(pose[:3])
        m = np.diag([1, -1, -1]) @ turn
        angles = [np.arctan2(-m[2, 1], m[2, 2]), np.arcsin(m[2, 0]), np.arctan2(-m[1, 0], m[0, 0])]
        photos.append(dict(id=f"f{k}", camera="c", position=(-turn.T @ pose[3:]).tolist(), rotation=angles))
        observations += [dict(photo=f"f{k}", point=f"p{n}", u=x + 0.5, v=y + 0.5, sigma=1 / weight) for n, (x, y, weight) in enumerate(frame) if weight > 0]
    project = dict(format="sightline", version=1, unit="m", cameras=[camera], photos=photos, observations=observations, datum=dict(kind="control"),
                   points=[dict(id=f"p{n}", xyz=at.tolist(), role="control", sigma=[0, 0, 0]) for n, at in enumerate(board)])
    with tempfile.TemporaryDirectory() as folder:
        saved = save(f"{folder}/project.json", project)
        found = ours("uncertainty", saved, save(f"{folder}/options.json", dict(camera="c", grid=[13, 9], reference="photos")))
        map_ = found["uncertainty"]
        grid = np.array([[u, v] for v in map_["v"] for u in map_["u"]])
        rays = peer.unproject(grid - 0.5, *model.intrinsics(), normalize=True)
        theirs = peer.projection_uncertainty(rays, model, atinfinity=True, what="worstdirection-stdev", observed_pixel_uncertainty=found["sigma0"])
        here = np.array([np.nan if s is None else s for row in map_["sigma"] for s in row])
        both = np.isfinite(theirs) & np.isfinite(here)
        assert both.sum() > 100, both.sum()
        judge("mrcal projection uncertainty at infinity, quotient", np.ones(both.sum()), here[both] / theirs[both], 0.02)
        # By distance: from a tenth of the nearest board to ten times the farthest, at the centre and on the half diagonals.
        distances = np.geomspace(0.1, 30, 16).tolist()
        places = [[width * (1 + a) / 2, height * (1 + b) / 2] for a, b in [(0, 0), (-0.6, -0.6), (0.6, -0.6), (-0.6, 0.6), (0.8, 0.8)]]
        found = ours("distances", saved, save(f"{folder}/options.json", dict(camera="c", distances=distances, places=places)))
        rays = peer.unproject(np.array(places) - 0.5, *model.intrinsics(), normalize=True)
        for place, ray in zip(found["uncertainty"]["places"], rays):
            near = peer.projection_uncertainty(np.outer(distances, ray), model, what="worstdirection-stdev", observed_pixel_uncertainty=found["sigma0"])
            far = peer.projection_uncertainty(ray, model, atinfinity=True, what="worstdirection-stdev", observed_pixel_uncertainty=found["sigma0"])
            here = np.array([*place["sigma"], place["infinity"]], float)
            theirs = np.array([*near, far])
            judge(f"mrcal projection uncertainty over distance at {place['u']:.0f}, {place['v']:.0f}, quotient", np.ones(len(here)), here / theirs, 0.02)


def colmap():
    peer = part("colmap", "pycolmap")
    if not peer:
        return
    u = random.uniform
    parameters = dict(
        SIMPLE_PINHOLE=lambda: [u(850, 950), u(600, 690), u(440, 520)],
        PINHOLE=lambda: [u(850, 950), u(850, 950), u(600, 690), u(440, 520)],
        SIMPLE_RADIAL=lambda: [u(850, 950), u(600, 690), u(440, 520), u(-0.2, 0.1)],
        RADIAL=lambda: [u(850, 950), u(600, 690), u(440, 520), u(-0.2, 0.1), u(-0.05, 0.05)],
        OPENCV=lambda: [u(850, 950), u(850, 950), u(600, 690), u(440, 520), u(-0.2, 0.1), u(-0.05, 0.05), u(1e-4, 2e-3), u(-3e-3, -2e-4)],
        FULL_OPENCV=lambda: [u(850, 950), u(850, 950), u(600, 690), u(440, 520), u(-0.2, 0.1), u(-0.05, 0.05), u(1e-4, 2e-3), u(-3e-3, -2e-4), u(-0.02, 0.02), 0, 0, 0])
    for binary in [False, True]:
        with tempfile.TemporaryDirectory() as folder:
            scene = synthetic(peer, parameters)
            os.mkdir(f"{folder}/theirs")
            (scene.write_binary if binary else scene.write_text)(f"{folder}/theirs")
            files = [f"{folder}/theirs/{name}" for name in sorted(os.listdir(f"{folder}/theirs"))]
            project = ours("import", "auto", *files)
            assert project["recognised"] == "colmap", project["recognised"]
            here = {(photo, point): pixel for photo, point, pixel in ours("project", save(f"{folder}/p.json", project))}
            kind = "binary" if binary else "text"
            compare(peer, scene, here, f"colmap {kind} of pycolmap")
            measured = {(str(i), str(p.point3D_id)): p.xy for i, image in scene.images.items() for p in image.points2D if p.has_point3D()}
            found = {(o["photo"], o["point"]): (o["u"], o["v"]) for o in project["observations"]}
            assert measured.keys() == found.keys(), "keypoints"
            judge(f"colmap {kind} keypoints", [measured[k] for k in measured], [found[k] for k in measured], 1e-12)
            ours("export", "colmap-binary" if binary else "colmap", f"{folder}/p.json", f"{folder}/ours")
            back = peer.Reconstruction(f"{folder}/ours")
            assert back.num_points3D() == scene.num_points3D() and back.num_images() == scene.num_images()
            compare(peer, back, here, f"colmap {kind} written")
            assert all(len(back.points3D[i].track.elements) == len(point.track.elements) for i, point in scene.points3D.items()), "tracks"
            passed.append("tracks")


def synthetic(peer, parameters):
    """A scene of a camera of each model with points, keypoints that are their images, and keypoints of no point."""
    scene = peer.Reconstruction()
    at = random.uniform(-1, 1, (60, 3))
    tracks = [peer.Track() for _ in at]
    for number, (model, values) in enumerate(parameters.items(), 1):
        camera = peer.Camera(model=model, width=1280, height=960, params=values(), camera_id=number)
        scene.add_camera_with_trivial_rig(camera)
        turn = random.normal(size=4)
        rotation = peer.Rotation3d(turn / np.linalg.norm(turn))
        pose = peer.Rigid3d(rotation, np.array([0.1, -0.2, 4.0]))
        image = peer.Image(name=f"photo {number}.jpg", camera_id=number, image_id=number)
        seen = [camera.img_from_cam(pose * p) for p in at]
        image.points2D = peer.Point2DList([peer.Point2D(np.asarray(p).ravel()) for p in seen] + [peer.Point2D(np.array([5.0, 7.0]))])
        scene.add_image_with_trivial_frame(image, pose)
        for k, track in enumerate(tracks):
            track.add_element(number, k)
    for p, track in zip(at, tracks):
        scene.add_point3D(p, track, np.array([1, 2, 3], np.uint8))
    return scene


def compare(peer, scene, here, name):
    theirs, mine = [], []
    for number, image in scene.images.items():
        for i, point in scene.points3D.items():
            pixel = scene.cameras[image.camera_id].img_from_cam(image.cam_from_world() * point.xyz)
            theirs.append(np.asarray(pixel).ravel())
            mine.append(here[(str(number), str(i))])
    judge(name, theirs, mine)


every([opencv, ros_and_kalibr, mrcal, colmap])
