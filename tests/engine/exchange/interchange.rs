//! Cameras and networks of other programs: conventions by their published equations, round trips, damage.

use crate::support::data::{data, text};
use nalgebra::{Matrix3, Rotation3, Vector3};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};
use sightline::camera::pixel_from_camera_point;
use sightline::error::Error;
use sightline::project::{Camera, Interior, Observation, Photo, Point, Project, Role, Sigma};
use sightline::rotation::{angles, object_to_camera};
use sightline_exchange::conversion::Covariance;
use sightline_exchange::foreign::{Assumed, CameraOptions};
use sightline_exchange::reason::ExchangeReason;
use sightline_exchange::{self as exchange, Choices, Files, cameras};

fn file(name: &str, content: impl Into<Vec<u8>>) -> Files {
    Files::from([(name.to_owned(), content.into())])
}

fn near(found: [f64; 2], expected: [f64; 2], limit: f64, what: &str) {
    let apart = (found[0] - expected[0]).hypot(found[1] - expected[1]);
    assert!(apart <= limit, "{what}: {found:?} is not {expected:?}");
}

/// Pixel of a point with x right, y down, z forwards.
fn pixel(camera: &Camera, [x, y, z]: [f64; 3]) -> [f64; 2] {
    pixel_from_camera_point(camera, Vector3::new(x, -y, -z)).expect("in front")
}

fn camera(format: &str, files: &Files) -> cameras::ImportedCameras {
    cameras::import(format, files, &CameraOptions::default()).unwrap_or_else(|error| panic!("{format}: {error}"))
}

/// Off axis in both directions.
const POINTS: [[f64; 3]; 4] = [[0.31, -0.22, 1.0], [-0.9, 0.5, 3.0], [0.1, 0.42, 1.3], [0.0, 0.0, 2.0]];

/// OpenCV's equations as its documentation has them, without the shift of the pixel frame.
fn by_opencv([fx, fy, cx, cy]: [f64; 4], d: &[f64], [x, y, z]: [f64; 3]) -> [f64; 2] {
    let d = |k: usize| d.get(k).copied().unwrap_or(0.0);
    let (x, y) = (x / z, y / z);
    let r2 = x * x + y * y;
    let radial =
        (1.0 + d(0) * r2 + d(1) * r2 * r2 + d(4) * r2.powi(3)) / (1.0 + d(5) * r2 + d(6) * r2 * r2 + d(7) * r2.powi(3));
    let xd = x * radial + 2.0 * d(2) * x * y + d(3) * (r2 + 2.0 * x * x);
    let yd = y * radial + d(2) * (r2 + 2.0 * y * y) + 2.0 * d(3) * x * y;
    [fx * xd + cx, fy * yd + cy]
}

#[test]
fn opencv_sample_camera() {
    let Some(bytes) = data("interchange/opencv-left.yml") else { return };
    let read = camera("auto", &file("left.yml", bytes));
    assert_eq!((read.format, read.cameras.len()), ("opencv", 1));
    assert!(read.ignored.iter().any(|ignored| ignored.name == "nframes"), "{:?}", read.ignored);
    let k = [5.3591573396163199e+02, 5.3591573396163199e+02, 3.4228315473308373e+02, 2.3557082909788173e+02];
    let d = [
        -2.6637260909660682e-01,
        -3.8588898922304653e-02,
        1.7831947042852964e-03,
        -2.8122100441115472e-04,
        2.3839153080878486e-01,
    ];
    let found = &read.cameras[0];
    assert_eq!((found.camera.width, found.camera.height, found.conversion.as_ref()), (640, 480, None));
    for point in POINTS {
        let [u, v] = by_opencv(k, &d, point);
        // The centre of the first pixel is (0.5, 0.5) here.
        near(pixel(&found.camera, point), [u + 0.5, v + 0.5], 1e-9, "left.yml");
    }
}

#[test]
fn mrcal_models_are_read_without_conversion() {
    let Some(bytes) = data("interchange/cam0.opencv8.cameramodel") else { return };
    let read = camera("auto", &file("cam0.cameramodel", bytes));
    assert_eq!(read.format, "mrcal");
    let found = &read.cameras[0];
    assert_eq!((found.conversion.as_ref(), found.camera.interior.model().name), (None, "opencv_rational"));
    let k = [1761.181055, 1761.250444, 1965.706996, 1087.518797];
    let d = [
        -0.01266096516,
        0.03590794372,
        -0.0002547045941,
        0.0005275929652,
        0.01968883397,
        0.01482863541,
        -0.0562239888,
        0.0500223357,
    ];
    for point in POINTS {
        let [u, v] = by_opencv(k, &d, point);
        near(pixel(&found.camera, point), [u + 0.5, v + 0.5], 1e-9, "cam0");
    }
    // Reference to camera: x_camera = R x + t.
    let rotation = Rotation3::new(Vector3::new(2e-2, -3e-1, -1e-2));
    let expected = -(rotation.inverse() * Vector3::new(1.0, 2.0, -3.0));
    let position = found.position.expect("extrinsics");
    assert!((Vector3::from(position) - expected).norm() < 1e-12, "{position:?}");
    let turned = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, -1.0)) * rotation.matrix();
    let apart = object_to_camera(found.rotation.expect("extrinsics")) - turned;
    assert!(apart.amax() < 1e-12, "{apart}");
    let wide =
        file("overpass.cameramodel", data("interchange/overpass-opencv8.cameramodel").expect("beside the other"));
    let read = cameras::import("mrcal", &wide, &CameraOptions::default()).unwrap();
    assert_eq!(
        (read.cameras[0].conversion.as_ref(), read.cameras[0].camera.interior.model().name),
        (None, "opencv_rational")
    );
    assert!(read.ignored.iter().any(|ignored| ignored.name == "optimization_inputs"));
    assert_eq!(read.cameras[0].region.as_ref().map(Vec::len), Some(42));
}

#[test]
fn colmap_cameras() {
    let Some(bytes) = data("interchange/colmap-cameras.txt") else { return };
    let read = camera("auto", &file("cameras.txt", bytes));
    assert_eq!((read.format, read.cameras.len()), ("colmap", 11));
    let found = &read.cameras[1].camera;
    assert_eq!((found.id.as_str(), found.width, found.height), ("2", 2832, 2128));
    for [x, y, z] in POINTS {
        let (a, b) = (x / z, y / z);
        let radial = 1.0 - 0.171078 * (a * a + b * b);
        near(pixel(found, [x, y, z]), [2981.08 * a * radial + 1416.0, 2981.08 * b * radial + 1064.0], 1e-9, "camera 2");
    }
}

#[test]
fn bal_problem() {
    let Some(text) = text("interchange/bal-3-7.txt") else { return };
    let read = exchange::import_files("auto", &file("problem.txt", text.as_bytes()), &Choices::default()).unwrap();
    assert_eq!(read.recognised, Some("bal"));
    let project = read.project;
    assert_eq!((project.photos.len(), project.points.len(), project.observations.len()), (3, 7, 19));
    let numbers: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    let (cameras, points) = (&numbers[3 + 4 * 19..], &numbers[3 + 4 * 19 + 27..]);
    let (mut squares, mut mirrored): (f64, f64) = (0.0, 0.0);
    for (k, seen) in numbers[3..3 + 4 * 19].chunks(4).enumerate() {
        let c = &cameras[9 * seen[0] as usize..][..9];
        let x = &points[3 * seen[1] as usize..][..3];
        let p = Rotation3::new(Vector3::new(c[0], c[1], c[2])) * Vector3::new(x[0], x[1], x[2])
            + Vector3::new(c[3], c[4], c[5]);
        let (a, b) = (-p.x / p.z, -p.y / p.z);
        let r2 = a * a + b * b;
        let radial = c[6] * (1.0 + c[7] * r2 + c[8] * r2 * r2);
        let photo = &project.photos[seen[0] as usize];
        let own = project.cameras.iter().find(|camera| camera.id == photo.camera).unwrap();
        let of_document = &project.observations[k];
        let (w, h) = (f64::from(own.width), f64::from(own.height));
        near([of_document.u, of_document.v], [w / 2.0 + seen[2], h / 2.0 - seen[3]], 1e-9, "measured");
        let here = project_point(&project, photo, Vector3::new(x[0], x[1], x[2])).unwrap();
        near(here, [w / 2.0 + radial * a, h / 2.0 - radial * b], 1e-8, "projected");
        squares += (here[0] - of_document.u).powi(2) + (here[1] - of_document.v).powi(2);
        mirrored += (here[0] - of_document.u).powi(2) + (h - here[1] - of_document.v).powi(2);
    }
    // Initial values of a problem before its adjustment; with y the other way they would be images of nothing.
    let (rms, mirrored) = ((squares / 19.0f64).sqrt(), (mirrored / 19.0f64).sqrt());
    assert!((rms - 17.058).abs() < 0.001 && mirrored > 10.0 * rms, "{rms} {mirrored} px");
}

#[test]
fn meshroom_versions() {
    if let Some(bytes) = data("interchange/small.sfm") {
        let read = exchange::import_files("auto", &file("small.sfm", bytes), &Choices::default()).unwrap();
        assert_eq!(read.recognised, Some("meshroom"));
        let Interior::Opencv { fx: Some(fx), fy: Some(fy), cx, cy, .. } = read.project.cameras[0].interior else {
            panic!()
        };
        let expected = 43.45584412271571 / 36.0 * 6016.0;
        near([fx, fy], [expected, expected], 1e-9, "focal length");
        assert_eq!([cx, cy], [3008.0, 1600.0]);
        assert!(read.project.photos.len() > 5 && read.project.photos.iter().all(|photo| photo.position.is_none()));
    }
    let scene = |version: &str, focal: &str, pp: &str| {
        format!(
            r#"{{"version": [{version}], "views": [], "intrinsics": [{{"intrinsicId": "7", "width": "1000", "height": "800", "sensorWidth": "20",
            "type": "brown", {focal}, "principalPoint": [{pp}], "distortionParams": ["-0.1", "0.02", "-0.003", "0.001", "-0.002"]}}]}}"#
        )
    };
    for (version, focal, pp) in [
        (r#""1","0","0""#, r#""pxFocalLength": "900""#, r#""503.5", "396.25""#),
        (r#""1","2","0""#, r#""pxFocalLength": ["900", "903"]"#, r#""503.5", "396.25""#),
        (r#""1","2","1""#, r#""pxFocalLength": ["900", "903"]"#, r#""3.5", "-3.75""#),
        (r#""1","2","3""#, r#""focalLength": "18", "pixelRatio": "0.99667774086378735""#, r#""3.5", "-3.75""#),
        (r#""1","2","8""#, r#""focalLength": "18", "pixelRatio": "1.0033333333333334""#, r#""3.5", "-3.75""#),
    ] {
        let read = camera("meshroom", &file("a.sfm", scene(version, focal, pp)));
        let fy = if version.contains("\"0\",\"0\"") { 900.0 } else { 903.0 };
        for point in POINTS {
            let expected = by_opencv([900.0, fy, 503.5, 396.25], &[-0.1, 0.02, 0.001, -0.002, -0.003], point);
            near(pixel(&read.cameras[0].camera, point), expected, 1e-8, version);
        }
    }
}

/// f, cx, cy, b1, k1 to k3, p1, p2 by the manual of Metashape.
#[test]
fn agisoft_lens_and_metashape_project() {
    let lens = "<f>3000.5</f><cx>12.5</cx><cy>-7.25</cy><b1>4.5</b1><k1>-0.05</k1><k2>0.02</k2><k3>-0.003</k3><p1>0.001</p1><p2>-0.0005</p2>";
    let by_manual = |[x, y, z]: [f64; 3]| {
        let (x, y) = (x / z, y / z);
        let r2 = x * x + y * y;
        let radial = 1.0 - 0.05 * r2 + 0.02 * r2 * r2 - 0.003 * r2.powi(3);
        let (p1, p2) = (0.001, -0.0005);
        let xd = x * radial + p1 * (r2 + 2.0 * x * x) + 2.0 * p2 * x * y;
        let yd = y * radial + p2 * (r2 + 2.0 * y * y) + 2.0 * p1 * x * y;
        [2000.0 + 12.5 + xd * 3000.5 + xd * 4.5, 1500.0 - 7.25 + yd * 3000.5]
    };
    let calibration = format!(
        "<?xml version=\"1.0\"?><calibration><projection>frame</projection><width>4000</width><height>3000</height>{lens}<date>2020</date></calibration>"
    );
    let read = camera("auto", &file("lens.xml", calibration));
    assert_eq!((read.format, read.ignored[0].name.as_str()), ("agisoft-lens", "date"));
    for point in POINTS {
        near(pixel(&read.cameras[0].camera, point), by_manual(point), 1e-9, "lens");
    }
    // Camera to chunk, then the chunk to the object: scale 2, a quarter turn about z, a shift.
    let project = format!(
        "<document version=\"1.5.0\"><chunk label=\"c\"><sensors><sensor id=\"0\" type=\"frame\"><calibration type=\"frame\" class=\"initial\"><resolution width=\"1\" height=\"1\"/><f>1</f></calibration>
        <calibration type=\"frame\" class=\"adjusted\"><resolution width=\"4000\" height=\"3000\"/>{lens}</calibration></sensor></sensors>
        <components><component id=\"0\"><transform><rotation>0 -1 0 1 0 0 0 0 1</rotation><translation>10 20 30</translation><scale>2</scale></transform></component></components>
        <cameras><camera id=\"5\" sensor_id=\"0\" component_id=\"0\" label=\"IMG_1\"><transform>1 0 0 1 0 1 0 2 0 0 1 3 0 0 0 1</transform><reference x=\"1\" y=\"2\" z=\"3\"/></camera></cameras>
        <markers><marker id=\"3\" label=\"A\"><reference x=\"8\" y=\"24\" z=\"50\" sx=\"0.01\" enabled=\"true\"/></marker><marker id=\"4\" label=\"B\"><reference x=\"1\" y=\"2\" z=\"3\" enabled=\"0\"/></marker><marker id=\"9\" label=\"C\"/></markers>
        <frames><frame id=\"0\"><markers><marker marker_id=\"3\"><location camera_id=\"5\" pinned=\"true\" x=\"100.5\" y=\"200.25\"/></marker><marker marker_id=\"9\"><location camera_id=\"5\" pinned=\"false\" x=\"1\" y=\"2\"/></marker></markers></frame></frames>
        <reference>LOCAL_CS[\"Local Coordinates (m)\",LOCAL_DATUM[\"Local Datum\",0],UNIT[\"metre\",1]]</reference>
        <settings><property name=\"accuracy_markers\" value=\"0.005\"/><property name=\"accuracy_projections\" value=\"0.1\"/></settings><region/></chunk></document>"
    );
    let read = exchange::import_files("auto", &file("cameras.xml", project.as_bytes()), &Choices::default()).unwrap();
    assert_eq!(read.recognised, Some("metashape"));
    let found = &read.project;
    assert_eq!((found.unit.as_str(), found.photos[0].id.as_str()), ("m", "IMG_1"));
    assert_eq!(found.photos[0].position, Some([10.0 - 4.0, 20.0 + 2.0, 30.0 + 6.0]));
    // A point two units before the camera in the chunk's length, (0.5, -0.25, 2) in its frame: (1.5, 1.75, 5) in the chunk.
    let object = Vector3::new(10.0 - 2.0 * 1.75, 20.0 + 2.0 * 1.5, 30.0 + 2.0 * 5.0);
    near(project_point(found, &found.photos[0], object).unwrap(), by_manual([0.5, -0.25, 2.0]), 1e-8, "pose");
    let roles: Vec<Role> = found.points.iter().map(|point| point.role).collect();
    assert_eq!(roles, [Role::Control, Role::Check, Role::Tie]);
    assert_eq!(found.points[0].sigma, Some([Some(0.01), Some(0.005), Some(0.005)]));
    assert_eq!(
        (found.observations[0].sigma, found.observations[0].enabled, found.observations[1].enabled),
        (Sigma::One(0.1), true, false)
    );
    let ignored: Vec<&str> = read.notes.ignored.iter().map(|ignored| ignored.name.as_str()).collect();
    assert_eq!(ignored, ["reference coordinates of cameras", "region"]);
    // Coordinates of a map projection are another system than that of the cameras.
    let mapped = project.replace("LOCAL_CS[", "PROJCS[");
    let read = exchange::import_files("metashape", &file("cameras.xml", mapped), &Choices::default()).unwrap();
    assert!(
        read.notes.assumed.contains(&Assumed::SystemOfChunk)
            && read.project.points.iter().all(|point| point.xyz.is_none())
    );
}

#[test]
fn micmac_calibration() {
    let xml = |centre: &str, more: &str| {
        format!(
            "<ExportAPERO><CalibrationInternConique><KnownConv>eConvApero_DistM2C</KnownConv><PP>2010.5 1493.25</PP><F>3000.5</F><SzIm>4000 3000</SzIm>
            <CalibDistortion><ModPhgrStd><RadiePart><CDist>{centre}</CDist><CoeffDist>3e-9</CoeffDist><CoeffDist>-2e-16</CoeffDist>{more}</RadiePart>
            <P1>2e-7</P1><P2>-5e-7</P2><b1>3e-4</b1><b2>-2e-4</b2></ModPhgrStd></CalibDistortion></CalibrationInternConique></ExportAPERO>"
        )
    };
    let direction = |centre: [f64; 2], k5: f64, [u, v]: [f64; 2]| {
        let (x, y) = (u - centre[0], v - centre[1]);
        let r2 = x * x + y * y;
        let radial = 3e-9 * r2 - 2e-16 * r2 * r2 + k5 * r2.powi(4);
        let dx = x * radial + 2e-7 * (r2 + 2.0 * x * x) - 2.0 * 5e-7 * x * y + 3e-4 * x - 2e-4 * y;
        let dy = y * radial - 5e-7 * (r2 + 2.0 * y * y) + 2.0 * 2e-7 * x * y;
        [(u + dx - 2010.5) / 3000.5, (v + dy - 1493.25) / 3000.5]
    };
    let exact = camera("auto", &file("AutoCal.xml", xml("2010.5 1493.25", "")));
    assert_eq!((exact.format, exact.cameras[0].conversion.as_ref()), ("micmac", None));
    let other = camera(
        "micmac",
        &file("AutoCal.xml", xml("2003.25 1500.75", "<CoeffDist>0</CoeffDist><CoeffDist>1e-30</CoeffDist>")),
    );
    let conversion = other.cameras[0].conversion.clone().expect("a centre of its own");
    for measured in [[100.0, 50.0], [3900.0, 200.5], [1800.25, 2950.0], [2010.5, 1493.25]] {
        let [a, b] = direction([2010.5, 1493.25], 0.0, measured);
        near(pixel(&exact.cameras[0].camera, [a, b, 1.0]), measured, 1e-8, "exact");
        let [a, b] = direction([2003.25, 1500.75], 1e-30, measured);
        near(pixel(&other.cameras[0].camera, [a, b, 1.0]), measured, conversion.max_px * 1.01 + 1e-9, "converted");
    }
    // The fourth radial coefficient moves the corners by 4 px, of which 0.09 px cannot be taken up.
    assert!(conversion.warning && conversion.max_px < 0.1, "{conversion:?}");
}

#[test]
fn what_has_no_model_is_refused_by_name() {
    let kalibr = "cam0:\n  camera_model: pinhole\n  distortion_model: fov\n  distortion_coeffs: [0, 0, 0, 0]\n  intrinsics: [500, 500, 320, 240]\n  resolution: [640, 480]\n";
    let cases = [
        ("kalibr", "a.yaml", kalibr.to_owned(), "pinhole-fov"),
        ("kalibr", "a.yaml", kalibr.replace("pinhole", "omni"), "omni"),
        ("ros", "a.yaml", "image_width: 640\nimage_height: 480\ncamera_matrix: {rows: 3, cols: 3, data: [500, 0, 320, 0, 500, 240, 0, 0, 1]}\ndistortion_model: omni\ndistortion_coefficients: {rows: 1, cols: 4, data: [0, 0, 0, 0]}\n".into(), "omni"),
        ("mrcal", "a.cameramodel", "{'lensmodel': 'LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=30_Ny=20_fov_x_deg=170', 'intrinsics': [1.0], 'imagersize': [6, 4]}".into(), "LENSMODEL_SPLINED_STEREOGRAPHIC_order=3_Nx=30_Ny=20_fov_x_deg=170"),
        ("colmap", "cameras.txt", "1 THIN_PRISM_FISHEYE 640 480 500 500 320 240 0 0 0 0 0 0 0 0\n".into(), "THIN_PRISM_FISHEYE"),
        ("agisoft-lens", "a.xml", "<calibration><projection>fisheye</projection><width>6</width><height>4</height><f>3</f></calibration>".into(), "Metashape fisheye"),
        ("meshroom", "a.sfm", r#"{"version": ["1","2","5"], "intrinsics": [{"intrinsicId": "1", "width": "6", "height": "4", "type": "fisheye1", "focalLength": "3", "principalPoint": ["0","0"], "distortionParams": []}]}"#.into(), "fisheye1 "),
        ("micmac", "a.xml", "<ExportAPERO><CalibrationInternConique><PP>3 2</PP><F>5</F><SzIm>6 4</SzIm><CalibDistortion><ModUnif><TypeModele>eModele_FishEye_10_5_5</TypeModele></ModUnif></CalibDistortion></CalibrationInternConique></ExportAPERO>".into(), "MicMac ModUnif eModele_FishEye_10_5_5"),
    ];
    for (format, name, content, model) in cases {
        match cameras::import(format, &file(name, content), &CameraOptions::default()) {
            Err(error) => {
                let wanted = ExchangeReason::NoSuchCameraModel { model: model.to_owned() };
                assert_eq!(ExchangeReason::of_error(&error), Some(wanted), "{format}: {error}");
                assert_eq!(error.place().file.as_deref(), Some(name));
            }
            other => panic!("{format}: {other:?}"),
        }
    }
}

/// The rational and the fisheye model through every format that has them: the same camera back, and nothing converted.
#[test]
fn rational_and_fisheye_cameras_come_back_as_they_went() {
    let (fx, fy, cx, cy) = (Some(903.25), Some(911.5), 641.5, 472.25);
    let rational = Interior::OpencvRational {
        fx,
        fy,
        cx,
        cy,
        k1: 0.31,
        k2: 0.07,
        p1: 4e-4,
        p2: -3e-4,
        k3: 0.01,
        k4: 0.42,
        k5: 0.08,
        k6: 0.015,
    };
    let fisheye = Interior::OpencvFisheye { fx, fy, cx, cy, k1: -0.012, k2: 0.004, k3: -0.0011, k4: 0.00011 };
    let cases: [(Interior, &[&str]); 2] =
        [(rational, &["opencv", "ros", "mrcal", "colmap"]), (fisheye, &["opencv", "ros", "kalibr", "colmap"])];
    for (interior, formats) in cases {
        let camera = Camera::new("1", 1280, 960, interior);
        let names: Vec<String> = interior.parameters().iter().skip(1).map(|p| p.name().to_owned()).collect();
        let variance = |i: usize, k: usize| if i == k { 1e-6 * (1.0 + i as f64) } else { 1e-8 };
        let matrix = (0..names.len()).map(|i| (0..names.len()).map(|k| variance(i, k)).collect()).collect();
        let covariance = Covariance { parameters: names, matrix };
        for format in formats {
            let options = CameraOptions { covariance: Some(covariance.clone()), ..CameraOptions::default() };
            let written = cameras::export(format, &camera, &options).unwrap();
            assert_eq!(written.conversion, None, "{format}");
            let carried = written.covariance.clone().expect("converted");
            for (i, name) in covariance.parameters.iter().enumerate() {
                let place = carried.parameters.iter().position(|other| other == name).expect("by its name");
                let (ours, theirs) = (covariance.matrix[i][i], carried.matrix[place][place]);
                assert!((ours / theirs - 1.0).abs() < 1e-4, "{format} {name}: {ours} {theirs}");
            }
            let files = written.files.iter().filter(|(name, _)| !name.contains("covariance"));
            let files: Files = files.map(|(name, bytes)| (name.clone(), bytes.clone())).collect();
            let read = cameras::import(format, &files, &CameraOptions::default()).unwrap();
            assert_eq!(read.cameras[0].conversion, None, "{format}");
            assert_eq!(read.cameras[0].camera.interior, interior, "{format}");
        }
    }
}

fn project_point(project: &Project, photo: &Photo, point: Vector3<f64>) -> Option<[f64; 2]> {
    let camera = project.cameras.iter().find(|camera| camera.id == photo.camera)?;
    let p = object_to_camera(photo.rotation?) * (point - Vector3::from(photo.position?));
    pixel_from_camera_point(camera, p)
}

/// Two cameras with everything unequal, six photos around thirty points, exact measurements.
fn network(random: &mut ChaCha8Rng, centred: bool) -> Project {
    let mut draw = |low: f64, high: f64| low + (high - low) * (random.next_u32() as f64 / f64::from(u32::MAX));
    let mut project = Project { name: "net <1> & \"2\"".into(), unit: "m".into(), ..Project::default() };
    for id in ["lens a", "b"] {
        let f = draw(1100.0, 1300.0);
        let mut interior = Interior::Opencv {
            fx: Some(f),
            fy: Some(f * 1.003),
            cx: draw(620.0, 680.0),
            cy: draw(450.0, 510.0),
            k1: draw(-0.2, 0.1),
            k2: draw(-0.05, 0.05),
            p1: draw(1e-4, 2e-3),
            p2: draw(-2e-3, -1e-4),
            k3: draw(-0.02, 0.02),
        };
        if centred {
            let (k1, k2) = (draw(-0.2, 0.1), draw(-0.05, 0.05));
            interior =
                Interior::Opencv { fx: Some(f), fy: Some(f), cx: 640.0, cy: 480.0, k1, k2, p1: 0.0, p2: 0.0, k3: 0.0 };
        }
        project.cameras.push(Camera::new(id, 1280, 960, interior));
    }
    for k in 0..30 {
        let xyz = Some([draw(-1.0, 1.0), draw(-1.0, 1.0), draw(-1.0, 1.0)]);
        let role = if k < 4 { Role::Control } else { Role::Tie };
        project.points.push(Point { id: format!("P{k}"), role, xyz, ..Point::default() });
    }
    for k in 0..6 {
        let m = Rotation3::from_euler_angles(draw(-3.0, 3.0), draw(-1.5, 1.5), draw(-3.0, 3.0));
        // The camera looks along its -z: it stands 5 back from the middle.
        let position = (m.inverse() * Vector3::new(draw(-0.2, 0.2), draw(-0.2, 0.2), 5.0)).into();
        let camera = if k < 3 { "lens a" } else { "b" };
        project.photos.push(Photo {
            id: format!("photo {k}"),
            camera: camera.into(),
            file: format!("img-{k}.jpg"),
            position: Some(position),
            rotation: Some(angles(m.matrix())),
            enabled: true,
            ..Photo::default()
        });
    }
    for photo in &project.photos {
        for point in &project.points {
            let Some([u, v]) = project_point(&project, photo, point.xyz.unwrap().into()) else { continue };
            let (photo, point) = (photo.id.clone(), point.id.clone());
            project.observations.push(Observation {
                photo,
                point,
                u,
                v,
                sigma: Sigma::One(0.1),
                enabled: true,
                target: None,
            });
        }
    }
    project
}

const NETWORKS: [&str; 6] = ["colmap", "colmap-binary", "metashape", "meshroom", "bal", "bundler"];

/// Every point has the same image in every photo, in the file's own camera, as where it was measured.
#[test]
fn networks_come_back_with_the_same_images() {
    for seed in 0..4 {
        for format in NETWORKS {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let project = network(&mut random, matches!(format, "bal" | "bundler"));
            let written = exchange::export(format, &project, None).unwrap_or_else(|error| panic!("{format}: {error}"));
            assert!(written.contains_key("interchange.json"), "{format}");
            let files: Files = written.into_iter().filter(|(name, _)| name != "interchange.json").collect();
            let read = exchange::import_files("auto", &files, &Choices::default())
                .unwrap_or_else(|error| panic!("{format}: {error}"));
            assert_eq!(read.recognised, Some(format.trim_end_matches("-binary")));
            assert!(read.conversions.is_empty());
            let back = read.project;
            assert_eq!(
                (back.photos.len(), back.points.len(), back.observations.len()),
                (project.photos.len(), project.points.len(), project.observations.len()),
                "{format}"
            );
            let (mut apart, mut worst): (Vec<f64>, f64) = (Vec::new(), 0.0);
            for seen in &back.observations {
                let photo = back.photos.iter().find(|photo| photo.id == seen.photo).unwrap();
                let Some(xyz) = back.points.iter().find(|point| point.id == seen.point).unwrap().xyz else {
                    // The markers of Metashape that are no control have no coordinates in its files.
                    assert_eq!(format, "metashape");
                    continue;
                };
                let [u, v] = project_point(&back, photo, xyz.into()).unwrap();
                worst = worst.max((u - seen.u).hypot(v - seen.v));
                apart.push(u - seen.u);
            }
            assert!(worst < 1e-8 && apart.len() >= 24, "{format}: {worst} px over {}", apart.len());
        }
    }
}

/// A camera goes through every format that has its model, in both directions, without a difference; through the others with the stated one.
#[test]
fn cameras_come_back() {
    for seed in 0..3 {
        let mut random = ChaCha8Rng::seed_from_u64(100 + seed);
        let camera = network(&mut random, false).cameras.remove(0);
        for format in ["opencv", "ros", "kalibr", "mrcal", "colmap", "agisoft-lens", "micmac"] {
            let written =
                cameras::export(format, &camera, &CameraOptions { convert: true, ..CameraOptions::default() }).unwrap();
            let read = cameras::import("auto", &written.files, &CameraOptions::default())
                .unwrap_or_else(|error| panic!("{format}: {error}"));
            assert_eq!((read.format, read.cameras.len()), (format, 1));
            let limit = written.conversion.as_ref().map_or(1e-8, |conversion| conversion.max_px * 1.01);
            assert_eq!(written.conversion.is_some(), matches!(format, "kalibr" | "micmac"), "{format}");
            assert!(read.cameras[0].conversion.is_none(), "{format}");
            for [x, y, z] in POINTS {
                let point = [x * 0.8, y * 0.8, z];
                near(pixel(&read.cameras[0].camera, point), pixel(&camera, point), limit, format);
            }
        }
    }
}

/// Files cut and changed anywhere give a result or an error that says where, and come to an end.
#[test]
fn damaged_files_are_refused() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let project = network(&mut random, true);
    let mut errors = 0;
    let mut damaged = |format: &str, files: &Files, import: &dyn Fn(&Files) -> Result<(), Error>| {
        for (name, bytes) in files.iter().filter(|(name, _)| *name != "interchange.json") {
            for round in 0..60 {
                let mut changed = bytes.clone();
                let at = random.next_u32() as usize % changed.len().max(1);
                match round % 3 {
                    0 => changed.truncate(at),
                    1 => changed[at] = random.next_u32() as u8,
                    _ => {
                        changed.drain(at..(at + 1 + random.next_u32() as usize % 40).min(bytes.len()));
                    }
                }
                let mut all = files.clone();
                all.remove("interchange.json");
                all.insert(name.clone(), changed);
                if let Err(error) = import(&all) {
                    errors += 1;
                    let place = error.place();
                    let told = place != Default::default() || matches!(error, Error::Empty { .. });
                    assert!(told && !error.to_string().is_empty(), "{format}: {error:?}");
                }
            }
        }
    };
    for format in NETWORKS.into_iter().chain(["vstars"]) {
        let files = exchange::export(format, &project, None).unwrap();
        let named = format.trim_end_matches("-binary");
        damaged(format, &files, &|files| exchange::import_files(named, files, &Choices::default()).map(|_| ()));
    }
    for format in ["opencv", "ros", "kalibr", "mrcal", "colmap", "agisoft-lens", "micmac"] {
        let files = cameras::export(format, &project.cameras[0], &CameraOptions::default()).unwrap().files;
        damaged(format, &files, &|files| cameras::import(format, files, &CameraOptions::default()).map(|_| ()));
    }
    assert!(errors > 200, "{errors}");
}

#[test]
fn vstars_points() {
    let text = "Label,X,Y,Z,SigmaX,SigmaY,SigmaZ,Offset\nPOINT1 (12.5122, -2.2231, 3.4456); 0.0012, 0.0010, 0.0018\nREF22 -1.3132 3.5932 5.3768 0.0004 0.0008 0.0003\nCODE3,19.5422,-6.8776,2.7896\nN4,1,2,3,0.1,0.2,0.3,0.5\n";
    let read = exchange::import_files("vstars", &file("a.csv", text), &Choices::default()).unwrap();
    assert_eq!(read.project.points.len(), 4);
    assert_eq!(read.project.points[0].sigma, Some([Some(0.0012), Some(0.001), Some(0.0018)]));
    assert_eq!((read.project.points[2].xyz, read.project.points[2].sigma), (Some([19.5422, -6.8776, 2.7896]), None));
    assert_eq!((read.notes.ignored[0].name.as_str(), read.notes.ignored[0].count), ("further columns", 1));
    let written = exchange::export("vstars", &read.project, None).unwrap();
    let back = exchange::import_files("vstars", &written, &Choices::default()).unwrap();
    assert_eq!(back.project.points, read.project.points);
    for (wrong, line) in [("A 1 2 x", 1), ("A 1 2 3\nA 1 2 3", 2), ("A;1,5;2;3;0;0;0", 1), ("A 1 2 3 1 1 -1", 1)] {
        let error = exchange::import_files("vstars", &file("a.csv", wrong), &Choices::default()).unwrap_err();
        assert_eq!(error.place().line, Some(line), "{wrong}: {error}");
    }
}

#[test]
fn lengths_in_an_unknown_unit_are_not_written_as_metres() {
    let mut project = network(&mut ChaCha8Rng::seed_from_u64(9), false);
    for (unit, metres) in [("mm", "0.001"), ("ft", "0.3048"), ("m", "1.0")] {
        project.unit = unit.into();
        let written = exchange::export("metashape", &project, None).expect("a known unit");
        let text = String::from_utf8(written["cameras.xml"].clone()).expect("text");
        assert!(text.contains(&format!(",{metres}]]</reference>")), "{unit}");
    }
    project.unit = "span".into();
    let refused = exchange::export("metashape", &project, None).expect_err("an unknown unit").to_string();
    assert!(refused.contains("span") && refused.contains("mm"), "{refused}");
}

#[test]
fn a_lens_whose_principal_distances_do_not_fit_in_f_and_b1_is_refused() {
    let mut camera = network(&mut ChaCha8Rng::seed_from_u64(3), false).cameras.remove(0);
    camera.interior = Interior::Opencv {
        fx: Some(2.8e-306),
        fy: Some(500.0),
        cx: 320.0,
        cy: 240.0,
        k1: 0.0,
        k2: 0.0,
        k3: 0.0,
        p1: 0.0,
        p2: 0.0,
    };
    (camera.width, camera.height) = (640, 480);
    let refused =
        cameras::export("agisoft-lens", &camera, &CameraOptions::default()).expect_err("too small").to_string();
    assert!(refused.contains("fx"), "{refused}");
}

#[test]
fn a_size_that_no_picture_has_is_refused_in_every_format() {
    let files =
        Files::from([("cameras.txt".to_owned(), b"1 OPENCV 163840 140575200 500 500 320 240 0 0 0 0\n".to_vec())]);
    let refused = cameras::import("colmap", &files, &CameraOptions::default()).expect_err("damage").to_string();
    assert!(refused.contains("163840 140575200"), "{refused}");
}
