"""Networks, points and chains of cameras of other programs compared with programs that read and write these files.

    python3 tests/peers/networks.py PATH/TO/examples/interchange

| format | program |
| --- | --- |
| bundler | COLMAP (`colmap model_converter`) writes, GTSAM reads |
| nvm | COLMAP writes |
| bal | GTSAM reads |
| ros | the parsers of ROS (`camera_calibration_parsers`) and mrcal read and write again |
| kalibr | mrcal reads and writes |
| dxf, dxf-2010 | ezdxf reads |
| ply | plyfile reads |
| gltf | pygltflib reads |
| latitude, longitude, height | PROJ (pyproj) converts |

What is not installed is skipped by name; the last line is as that of interchange.py.
"""

import os
import re
import sys
import tempfile

import numpy as np

from common import every, judge, moved, opencv_camera, ours, part, passed, pixels, points, random, run, save, tool

# Debian keeps it out of the path.
ROS = "/usr/lib/camera_calibration_parsers/convert"
SIZE = [1280, 960]


def document(count=40):
    """A project of three photos and points in front of them; a camera that Snavely's f, k1, k2 at the centre of the picture describe."""
    u = random.uniform
    cameras, photos, observations = [], [], []
    at = random.uniform(-1, 1, (count, 3))
    for k in range(3):
        f = u(850, 950)
        cameras.append(dict(id=f"c{k}", width=SIZE[0], height=SIZE[1], model="opencv", fx=f, fy=f, cx=SIZE[0] / 2, cy=SIZE[1] / 2,
                            k1=u(-0.2, 0.1), k2=u(-0.05, 0.05), p1=0.0, p2=0.0, k3=0.0))
        # Five from the origin, looking back at it with a small turn and any roll.
        photos.append(dict(id=f"f{k}", camera=f"c{k}", position=[0.2 * u(-1, 1), 0.2 * u(-1, 1), 5.0], rotation=[u(-0.1, 0.1), u(-0.1, 0.1), u(-3, 3)]))
    project = dict(format="sightline", version=1, unit="m", cameras=cameras, photos=photos, observations=observations,
                   points=[dict(id=f"p{n}", xyz=xyz.tolist()) for n, xyz in enumerate(at)])
    with tempfile.TemporaryDirectory() as folder:
        for photo, point, [x, y] in projected(folder, project):
            observations.append(dict(photo=photo, point=point, u=x, v=y, sigma=0.5))
    assert len(observations) == 3 * count, "points outside of the pictures"
    return project


def projected(folder, project):
    return ours("project", save(f"{folder}/projected.json", project))


def table(rows, names):
    """Pixels by photo and point, in the order of the names."""
    found = {(photo, point): pixel for photo, point, pixel in rows}
    return np.array([found[name] for name in names])


def of_gtsam(data):
    """Images of all points in all photos by GTSAM, and its measurements: from the principal point, y down."""
    images = [[data.camera(i).project(data.track(j).point3()) for j in range(data.numberTracks())] for i in range(data.numberCameras())]
    measured = {}
    for j in range(data.numberTracks()):
        track = data.track(j)
        measured.update({(track.measurement(k)[0], j): track.measurement(k)[1] for k in range(track.numberMeasurements())})
    return np.array(images), measured


def written_for_gtsam():
    """What we write as bal and bundler, as GTSAM reads it; and files that are not ours, read by both."""
    gtsam = part("bal and bundler by GTSAM", "gtsam")
    if not gtsam:
        return
    reading = dict(bal=gtsam.SfmData.FromBalFile, bundler=gtsam.SfmData.FromBundlerFile)
    for name, read in reading.items():
        with tempfile.TemporaryDirectory() as folder:
            project = document()
            ours("export", name, save(f"{folder}/p.json", project), folder)
            path = next(f"{folder}/{file}" for file in sorted(os.listdir(folder)) if file.endswith((".out", ".txt")) and "list" not in file)
            images, measured = of_gtsam(read(path))
            names = [(photo["id"], point["id"]) for photo in project["photos"] for point in project["points"]]
            here = table(projected(folder, project), names) - np.array(SIZE) / 2
            judge(f"{name} written, images by GTSAM", images.reshape(-1, 2), here)
            given = {(o["photo"], o["point"]): [o["u"], o["v"]] for o in project["observations"]}
            own = [given[(f"f{i}", f"p{j}")] for i, j in measured]
            judge(f"{name} written, measurements by GTSAM", list(measured.values()), np.array(own) - np.array(SIZE) / 2, 1e-9)
    with tempfile.TemporaryDirectory() as folder:
        u, path = random.uniform, f"{folder}/problem.txt"
        cameras = [[u(-3, 3), u(-0.5, 0.5), u(-0.5, 0.5), u(-0.2, 0.2), u(-0.2, 0.2), u(-6, -5), u(500, 900), u(-0.1, 0.1), u(-0.02, 0.02)] for _ in range(3)]
        at = random.uniform(-1, 1, (20, 3))
        with open(path, "w") as file:
            file.write("3 20 60\n")
            file.writelines(f"{i} {j} {u(-300, 300)!r} {u(-300, 300)!r}\n" for j in range(20) for i in range(3))
            file.writelines(f"{x!r}\n" for values in [*cameras, *at.tolist()] for x in values)
        images, measured = of_gtsam(gtsam.SfmData.FromBalFile(path))
        compare_read("bal of a published layout", ours("import", "auto", path), images, measured)


def principal_point(camera):
    if camera["model"] != "brown":
        return np.array([camera["cx"], camera["cy"]])
    width, height = camera.get("pixel_pitch") or [1, 1]
    return np.array([camera["width"] / 2 + camera["x0"] / width, camera["height"] / 2 - camera["y0"] / height])


def compare_read(name, project, images, measured, digits=1e-9):
    """A file that both have read: images from the principal point and measurements, by places from 0."""
    centre = principal_point(project["cameras"][0])
    with tempfile.TemporaryDirectory() as folder:
        found = {(photo, point): pixel for photo, point, pixel in projected(folder, project)}
    names = [(str(i), str(j)) for i in range(images.shape[0]) for j in range(images.shape[1])]
    judge(f"{name} read, images", images.reshape(-1, 2), np.array([found[name] for name in names]) - centre)
    given = {(o["photo"], o["point"]): [o["u"], o["v"]] for o in project["observations"]}
    own = np.array([given[(str(i), str(j))] for i, j in measured])
    judge(f"{name} read, measurements", list(measured.values()), own - centre, digits)


def colmap_writes():
    """Bundler's and VisualSFM's files as COLMAP writes them from a model, with COLMAP's own images of the points."""
    peer, colmap, gtsam = part("bundler and nvm of COLMAP", "pycolmap"), tool("colmap"), part("bundler of COLMAP by GTSAM", "gtsam")
    if not peer or not colmap:
        return
    u = random.uniform
    # COLMAP writes VisualSFM's coefficient approximately: one of the opposite sense with the other sign.
    models = dict(Bundler=lambda k: [("RADIAL", [u(850, 950), 640.0, 480.0, u(-0.2, 0.1), u(-0.05, 0.05)]), ("SIMPLE_RADIAL", [u(850, 950), 640.0, 480.0, -0.1])][k % 2],
                  NVM=lambda k: ("SIMPLE_PINHOLE", [u(850, 950), 640.0, 480.0]))
    for kind, model in models.items():
        with tempfile.TemporaryDirectory() as folder:
            scene, at = peer.Reconstruction(), random.uniform(-1, 1, (30, 3))
            tracks = [peer.Track() for _ in at]
            for number in range(1, 4):
                name, values = model(number)
                camera = peer.Camera(model=name, width=SIZE[0], height=SIZE[1], params=values, camera_id=number)
                scene.add_camera_with_trivial_rig(camera)
                turn = random.normal(size=4)
                pose = peer.Rigid3d(peer.Rotation3d(turn / np.linalg.norm(turn)), np.array([0.1, -0.2, 5.0]))
                image = peer.Image(name=f"photo{number}.jpg", camera_id=number, image_id=number)
                image.points2D = peer.Point2DList([peer.Point2D(np.ravel(camera.img_from_cam(pose * p)) + random.normal(scale=0.3, size=2)) for p in at])
                scene.add_image_with_trivial_frame(image, pose)
                for k, track in enumerate(tracks):
                    track.add_element(number, k)
            for p, track in zip(at, tracks):
                scene.add_point3D(p, track, np.array([1, 2, 3], np.uint8))
            os.mkdir(f"{folder}/model")
            scene.write_text(f"{folder}/model")
            run(colmap, "model_converter", "--input_path", f"{folder}/model", "--output_path", f"{folder}/out.nvm", "--output_type", kind)
            files = sorted(f"{folder}/{name}" for name in os.listdir(folder) if name.startswith("out"))
            project = ours("import", "auto", *files)
            assert project["recognised"] == kind.lower() and len(project["photos"]) == 3 and len(project["points"]) == 30, project
            # Points stand in any order there.
            places = [int(np.argmin(np.linalg.norm(at - point["xyz"], axis=1))) for point in project["points"]]
            assert sorted(places) == list(range(30)), places
            images, measured = [], {}
            for i in range(3):
                image = scene.images[i + 1]
                images.append([np.ravel(scene.cameras[i + 1].img_from_cam(image.cam_from_world() * at[k])) - [640, 480] for k in places])
                measured.update({(i, j): image.points2D[k].xy - [640, 480] for j, k in enumerate(places)})
            by_place = {photo["id"]: str(i) for i, photo in enumerate(project["photos"])}
            for row in project["observations"]:
                row["photo"] = by_place[row["photo"]]
            for photo in project["photos"]:
                photo["id"] = by_place[photo["id"]]
            # COLMAP writes measurements with six digits, and those of VisualSFM's file from the corner: what is taken for the principal point is their median.
            found = [principal_point(camera) for camera in project["cameras"]]
            if kind == "NVM":
                judge("nvm of COLMAP, principal point", found, [[640, 480]] * len(found), 0.15)
            shift = found[0] - [640, 480] if kind == "NVM" else np.zeros(2)
            compare_read(f"{kind.lower()} of COLMAP", project, np.array(images), {key: pixel - shift for key, pixel in measured.items()}, 1e-3)
            if kind == "Bundler" and gtsam:
                theirs, _ = of_gtsam(gtsam.SfmData.FromBundlerFile(f"{folder}/out.nvm.bundle.out"))
                judge("bundler of COLMAP, GTSAM against COLMAP", theirs.reshape(-1, 2), np.array(images).reshape(-1, 2))


def ros():
    """Our camera_info through the parsers of ROS (YAML to INI and back), and as mrcal reads it."""
    camera, at = opencv_camera(), points()
    with tempfile.TemporaryDirectory() as folder:
        assert ours("write", "ros", save(f"{folder}/lens.json", camera), folder) is None
        here = pixels(folder, camera, at)
        convert = tool("convert of camera_calibration_parsers", ROS)
        if convert:
            run(convert, f"{folder}/camera_info.yaml", f"{folder}/there.ini")
            run(convert, f"{folder}/there.ini", f"{folder}/back.yaml")
            read = ours("read", "ros", f"{folder}/back.yaml")["cameras"][0]["camera"]
            # ROS writes INI files with five decimals.
            written = ours("read", "ros", f"{folder}/camera_info.yaml")["cameras"][0]["camera"]
            digits = [abs(read[name] - written[name]) for name in ["fx", "fy", "cx", "cy", "k1", "k2", "k3", "p1", "p2"]]
            judge("ros through the INI file of ROS, parameters", np.zeros(9), digits, 0.5e-5 + 1e-9)
            run(convert, f"{folder}/camera_info.yaml", f"{folder}/there.yaml")
            judge("ros through the YAML file of ROS", pixels(folder, ours("read", "ros", f"{folder}/there.yaml")["cameras"][0]["camera"], at), here)
        peer, from_ros = part("ros by mrcal", "mrcal"), tool("mrcal-from-ros")
        if peer and from_ros:
            run(sys.executable, from_ros, "--outdir", folder, "--force", f"{folder}/camera_info.yaml")
            model = peer.cameramodel(f"{folder}/camera_info.cameramodel")
            judge("ros written, by mrcal", peer.project(at, *model.intrinsics()) + 0.5, here)


def kalibr():
    """Chains that we write, as mrcal reads them, and that mrcal writes, as we read them: lenses and poses in the chain."""
    peer, from_kalibr, to_kalibr = part("kalibr by mrcal", "mrcal"), tool("mrcal-from-kalibr"), tool("mrcal-to-kalibr")
    if not peer or not from_kalibr or not to_kalibr:
        return
    camera, at = opencv_camera(), points()
    camera["k3"] = 0.0
    with tempfile.TemporaryDirectory() as folder:
        assert ours("write", "kalibr", save(f"{folder}/lens.json", camera), folder) is None
        run(sys.executable, from_kalibr, "--outdir", folder, "--force", f"{folder}/camchain.yaml")
        model = peer.cameramodel(next(f"{folder}/{name}" for name in os.listdir(folder) if name.endswith(".cameramodel")))
        judge("kalibr written, by mrcal", peer.project(at, *model.intrinsics()) + 0.5, pixels(folder, camera, at))
    with tempfile.TemporaryDirectory() as folder:
        models = []
        for k in range(3):
            u = random.uniform
            values = np.array([u(850, 950), u(860, 940), u(600, 690), u(440, 520), u(-0.2, 0.1), u(-0.05, 0.05), u(1e-4, 2e-3), u(-3e-3, -2e-4)])
            model = peer.cameramodel(intrinsics=("LENSMODEL_OPENCV4", values), imagersize=tuple(SIZE))
            model.rt_cam_ref(random.uniform(-0.2, 0.2, 6))
            model.write(f"{folder}/m{k}.cameramodel")
            models.append(model)
        chain = run(sys.executable, to_kalibr, "--cam0-at-reference", *(f"{folder}/m{k}.cameramodel" for k in range(3)))
        # It prints numbers of NumPy 2 by their type and, for coefficients, letters of the line above (mrcal 2.5): those are put in here, the rest is its own.
        chain = re.sub(r"np\.(?:float64|int32)\(([^)]*)\)", r"\1", chain)
        coefficients = iter(model.intrinsics()[1][4:].tolist() for model in models)
        chain = re.sub(r"distortion_coeffs: .*", lambda _: f"distortion_coeffs: {next(coefficients)}", chain)
        with open(f"{folder}/chain.yaml", "w") as file:
            file.write(chain)
        read = ours("read", "auto", f"{folder}/chain.yaml")
        assert read["format"] == "kalibr" and len(read["cameras"]) == 3, read
        first = models[0].rt_cam_ref()
        for k, (model, found) in enumerate(zip(models, read["cameras"])):
            judge(f"kalibr of mrcal, camera {k}", peer.project(at, *model.intrinsics()) + 0.5, pixels(folder, found["camera"], at))
            # Points of the first camera into this one.
            from_first = peer.compose_rt(model.rt_cam_ref(), peer.invert_rt(first))
            position, rotation = found.get("position") or [0.0] * 3, found.get("rotation")
            theirs = peer.transform_point_rt(from_first, at)
            mine = at if rotation is None and k == 0 else moved(position, rotation, at)
            # Far off the axis the polynomials of the distortion make pixels of nanometres.
            ahead = (theirs[:, 2] > 0.3) & np.all(np.abs(theirs[:, :2]) < 0.7 * theirs[:, 2:], axis=1)
            assert ahead.sum() > 50, ahead.sum()
            judge(f"kalibr of mrcal, pose of camera {k}", *(peer.project(seen[ahead], *model.intrinsics()) for seen in [theirs, mine]))


def drawings():
    """Points in drawings and models, as libraries of these formats read them: places, names, unit, layers in Korean."""
    project = document()
    project["points"][0]["id"] = "기준점 1"
    for row in project["observations"]:
        row["point"] = "기준점 1" if row["point"] == "p0" else row["point"]
    at = np.array([point["xyz"] for point in project["points"]])

    def same(name, found, limit):
        found = np.asarray(found, float)
        nearest = [np.linalg.norm(found - xyz, axis=1).min() for xyz in at]
        judge(name, np.zeros(len(at)), nearest, limit)

    for name, ending, module in [("dxf", ".dxf", "ezdxf"), ("dxf-2010", ".dxf", "ezdxf"), ("ply", ".ply", "plyfile"), ("gltf", ".glb", "pygltflib")]:
        library = part(f"{name} by {module}", module)
        if not library:
            continue
        with tempfile.TemporaryDirectory() as folder:
            ours("export", name, save(f"{folder}/p.json", project), f"{folder}/out")
            path = next(f"{folder}/out/{file}" for file in sorted(os.listdir(f"{folder}/out")) if file.endswith(ending) and file != "cameras.ply")
            if module == "ezdxf":
                drawing = library.readfile(path)
                assert not drawing.audit().errors, drawing.audit().errors
                same(f"{name} by ezdxf", [entity.dxf.location for entity in drawing.modelspace().query("POINT")], 1e-6)
                if name == "dxf-2010":
                    assert drawing.header["$INSUNITS"] == 6 and drawing.dxfversion == "AC1024", drawing.header["$INSUNITS"]
                texts = {entity.dxf.text for entity in drawing.modelspace().query("TEXT")}
                assert "기준점 1" in texts or name == "dxf", texts
                passed.append(f"{name} audited")
            elif module == "plyfile":
                vertices = library.PlyData.read(path)["vertex"]
                same("ply by plyfile", np.column_stack([vertices[axis] for axis in "xyz"]), 1e-6)
            else:
                same("gltf by pygltflib", positions(library.GLTF2().load(path)), 1e-6)


def positions(model):
    """The points of a glTF scene in our axes: moved by their nodes and the nodes above, Y up there."""
    found = []

    def walk(number, above):
        node = model.nodes[number]
        scale, [x, y, z, w] = np.diag(node.scale or [1, 1, 1]), node.rotation or [0, 0, 0, 1]
        turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
                         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]])
        own = np.eye(4)
        own[:3, :3], own[:3, 3] = turn @ scale, node.translation or [0, 0, 0]
        here = above @ own
        if node.mesh is not None and node.name == "points":
            accessor = model.accessors[model.meshes[node.mesh].primitives[0].attributes.POSITION]
            view = model.bufferViews[accessor.bufferView]
            begin = (view.byteOffset or 0) + (accessor.byteOffset or 0)
            xyz = np.frombuffer(model.binary_blob(), np.float32, 3 * accessor.count, begin).reshape(-1, 3)
            found.append(xyz @ here[:3, :3].T + here[:3, 3])
        for child in node.children or []:
            walk(child, here)

    for root in model.scenes[model.scene].nodes:
        walk(root, np.eye(4))
    world = np.vstack(found)
    return np.column_stack([world[:, 0], -world[:, 2], world[:, 1]])


def geographic():
    """Latitude, longitude and height in a local system, as PROJ converts them to the east, to the north and up."""
    pyproj = part("latitude and longitude by PROJ", "pyproj")
    if not pyproj:
        return
    with tempfile.TemporaryDirectory() as folder:
        rows = [(f"g{k}", 37.5 + random.uniform(-5e-3, 5e-3), 127.0 + random.uniform(-5e-3, 5e-3), random.uniform(20, 90)) for k in range(30)]
        with open(f"{folder}/list.csv", "w") as file:
            file.write("name,latitude,longitude,height\n")
            file.writelines(f"{name},{latitude!r},{longitude!r},{height!r}\n" for name, latitude, longitude, height in rows)
        project = ours("import", "control-csv", f"{folder}/list.csv")
        origin = project["origin"]["local_system"]
        print("   ", origin)
        latitude, longitude, height = (origin[name] for name in ["latitude", "longitude", "height"])
        there = pyproj.Transformer.from_pipeline(f"+proj=pipeline +step +proj=unitconvert +xy_in=deg +xy_out=rad +step +proj=cart +ellps=WGS84 "
                                                 f"+step +proj=topocentric +ellps=WGS84 +lon_0={longitude!r} +lat_0={latitude!r} +h_0={height!r}")
        theirs = [there.transform(longitude, latitude, height) for _, latitude, longitude, height in rows]
        found = {point["id"]: point["xyz"] for point in project["points"]}
        judge("latitude and longitude by PROJ, metres", theirs, [found[row[0]] for row in rows], 1e-7)


every([written_for_gtsam, colmap_writes, ros, kalibr, drawings, geographic])
