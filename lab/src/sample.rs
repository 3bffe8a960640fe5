//! The bundled sample project: photos rendered by the engine, of an object whose truth is known.
//!
//! A plate of 900 x 700 mm with a block on it, coded and uncoded targets on both, eight convergent photos of two
//! megapixels, every other one rolled; a scale bar and four surveyed points. Photos are rendered one at a time, so that
//! workers can share them.

pub mod epochs;

use std::f64::consts::{FRAC_PI_2, TAU};

use sightline::error::Result;
use sightline::exif::PhotoInfo;
use sightline::project::{Camera, Interior, Parameter, Photo, Project, Role, Sigma};
use sightline::ring_code::{Design, valid_codes};
use sightline_plan::network::{Bar, Network, NetworkPoint, Source, Station, photo, simulate};
use sightline_plan::render::{Exposure, png};
use sightline_plan::scene::{Face, Patch, Ring};

/// Block on the plate: two corners, mm.
const BLOCK: [[f64; 3]; 2] = [[-140.0, -90.0, 0.0], [160.0, 110.0, 160.0]];
/// Diameter of coded and of plain targets, mm.
const CODED_MM: f64 = 12.0;
const PLAIN_MM: f64 = 9.0;
/// Points whose surveyed coordinates come with the project, with their standard error in mm.
const CONTROL: [&str; 4] = ["1", "3", "7", "9"];
const CONTROL_SIGMA_MM: f64 = 0.02;
/// Ends of the scale bar and the standard error of its length in mm.
const BAR: [&str; 2] = ["2", "8"];
const BAR_SIGMA_MM: f64 = 0.01;

/// The network behind the sample, with its true values.
pub fn network() -> Network {
    let mut points = coded();
    points.extend(plain());
    Network {
        name: "Sample".into(),
        cameras: vec![camera()],
        stations: stations(),
        points,
        faces: faces(),
        background: 0.1,
        distances: vec![Bar { from: BAR[0].into(), to: BAR[1].into(), sigma: BAR_SIGMA_MM }],
        sigma: Sigma::One(0.05),
        observations: Source::Rendered,
        exposure: Exposure { psf: 0.8, seed: 42, ..Exposure::default() },
        ..Network::default()
    }
}

/// The project as a user begins it: photos by name, the camera's nominal focal length, the given coordinates and the
/// scale bar; nothing measured, nothing oriented.
///
/// # Errors
/// None for this network; the type is that of [`simulate`].
pub fn project() -> Result<Project> {
    let mut network = network();
    // Computed, not rendered: only the given coordinates and the distance are used.
    network.observations = Source::Noisy;
    let mut project = simulate(&network)?;
    project.observations.clear();
    project.points.retain(|point| point.role == Role::Control);
    // A scale bar's ends are points too.
    for id in BAR {
        project.points.push(sightline::project::Point { id: id.into(), ..Default::default() });
    }
    for camera in &mut project.cameras {
        camera.interior = Interior::brown(NOMINAL_MM);
        camera.free = FREE.to_vec();
    }
    for photo in &mut project.photos {
        *photo = Photo { position: None, rotation: None, ..photo.clone() };
    }
    Ok(project)
}

/// Names of the photo files.
pub fn files() -> Vec<String> {
    stations().iter().map(|station| format!("{}.png", station.id)).collect()
}

/// One photo as a PNG file with the camera's EXIF block, rendered now.
///
/// # Errors
/// [`crate::Error::Unknown`] for a name that is not among [`files`].
pub fn file(name: &str) -> Result<Vec<u8>> {
    let station = name.strip_suffix(".png").unwrap_or(name);
    let info = PhotoInfo {
        make: Some("Sightline".into()),
        model: Some("Sample 2 MP".into()),
        focal_length_mm: Some(NOMINAL_MM),
        pixel_pitch: Some([PITCH_MM; 2]),
        ..PhotoInfo::default()
    };
    png(&photo(&network(), station)?, Some(&info))
}

/// Focal length as engraved; the true principal distance is a little longer.
const NOMINAL_MM: f64 = 8.0;
const PITCH_MM: f64 = 0.0045;
const FREE: [Parameter; 8] = [
    Parameter::C,
    Parameter::X0,
    Parameter::Y0,
    Parameter::K1,
    Parameter::K2,
    Parameter::K3,
    Parameter::P1,
    Parameter::P2,
];

fn camera() -> Camera {
    let mut interior = Interior::brown(8.1274);
    let truth = [
        (Parameter::X0, 0.0413),
        (Parameter::Y0, -0.0287),
        (Parameter::K1, 1.62e-3),
        (Parameter::K2, -2.4e-5),
        (Parameter::K3, 3.1e-7),
        (Parameter::P1, 4.2e-5),
        (Parameter::P2, -3.1e-5),
    ];
    truth.into_iter().for_each(|(parameter, value)| interior.set(parameter, value));
    Camera { pixel_pitch: Some([PITCH_MM; 2]), free: FREE.to_vec(), ..Camera::new("sample", 1632, 1224, interior) }
}

/// Eight photos around the plate from about 50° above it.
fn stations() -> Vec<Station> {
    let station = |k: u32| {
        let azimuth = TAU * (f64::from(k) + 0.3) / 8.0;
        let height = if k.is_multiple_of(2) { 1030.0 } else { 1220.0 };
        let position = [860.0 * azimuth.cos(), 860.0 * azimuth.sin(), height];
        let roll = if k.is_multiple_of(2) { 0.0 } else { FRAC_PI_2 };
        Station::aimed(format!("sample-{}", k + 1), "sample", position, [0.0, 0.0, 30.0], roll)
    };
    (0..8).map(station).collect()
}

fn coded() -> Vec<NetworkPoint> {
    let codes = valid_codes(14);
    let up = [0.0, 0.0, 1.0];
    // A frame of eight on the plate and the ninth in its corner, four on the block's top.
    let places = [
        [-390.0, -290.0, 0.0],
        [0.0, -280.0, 0.0],
        [390.0, -290.0, 0.0],
        [380.0, 20.0, 0.0],
        [-380.0, 10.0, 0.0],
        [-250.0, 190.0, 0.0],
        [-390.0, 290.0, 0.0],
        [10.0, 285.0, 0.0],
        [390.0, 290.0, 0.0],
        [-100.0, -50.0, 160.0],
        [120.0, -50.0, 160.0],
        [120.0, 70.0, 160.0],
        [-100.0, 70.0, 160.0],
    ];
    let point = |(k, xyz): (usize, [f64; 3])| {
        let id = (k + 1).to_string();
        let control = CONTROL.contains(&id.as_str());
        NetworkPoint {
            role: if control { Role::Control } else { Role::Tie },
            sigma: control.then_some([Some(CONTROL_SIGMA_MM); 3]),
            xyz,
            normal: Some(up),
            diameter: Some(CODED_MM),
            ring: Some(Ring { sectors: 14, code: codes[k], design: Design::Schneider }),
            patch: Some(Patch { ratio: 4.0, grey: 0.04 }),
            id,
            ..NetworkPoint::default()
        }
    };
    places.into_iter().enumerate().map(point).collect()
}

fn plain() -> Vec<NetworkPoint> {
    let mut points = Vec::new();
    let mut add = |xyz: [f64; 3], normal: [f64; 3]| {
        points.push(NetworkPoint {
            id: format!("{}", 1001 + points.len()),
            xyz,
            normal: Some(normal),
            diameter: Some(PLAIN_MM),
            patch: Some(Patch { ratio: 3.0, grey: 0.04 }),
            ..NetworkPoint::default()
        });
    };
    let frame: Vec<_> = coded().iter().map(|p| p.xyz).collect();
    for j in 0..6 {
        for i in 0..9 {
            // Off the grid's lines, so that no two look alike.
            let wave = f64::from(i * 7 + j * 5).sin() * 9.0;
            let [x, y] = [f64::from(i - 4) * 95.0 + wave, (f64::from(j) - 2.5) * 108.0 - wave];
            let [low, high] = BLOCK;
            let on_block = x > low[0] - 25.0 && x < high[0] + 25.0 && y > low[1] - 25.0 && y < high[1] + 25.0;
            let free = frame.iter().all(|p| (p[0] - x).hypot(p[1] - y) > 48.0);
            if !on_block && free {
                add([x, y, 0.0], [0.0, 0.0, 1.0]);
            }
        }
    }
    let [low, high] = BLOCK;
    for (x, y) in [(10.0, -55.0), (10.0, 10.0), (10.0, 75.0), (-60.0, 10.0), (85.0, 12.0)] {
        add([x, y, high[2]], [0.0, 0.0, 1.0]);
    }
    for (share, z) in [(0.15, 40.0), (0.5, 120.0), (0.85, 45.0), (0.3, 90.0), (0.7, 80.0)] {
        let (x, y) = (low[0] + share * (high[0] - low[0]), low[1] + share * (high[1] - low[1]));
        add([x, low[1], z], [0.0, -1.0, 0.0]);
        add([x, high[1], z], [0.0, 1.0, 0.0]);
        add([low[0], y, z], [-1.0, 0.0, 0.0]);
        add([high[0], y, z], [1.0, 0.0, 0.0]);
    }
    points
}

/// Plate, block and floor.
fn faces() -> Vec<Face> {
    let [low, high] = BLOCK;
    let [dx, dy, dz] = [high[0] - low[0], high[1] - low[1], high[2] - low[2]];
    let face = |corner: [f64; 3], along: [f64; 3], across: [f64; 3], grey: f64| Face {
        corner,
        along,
        across,
        grey,
        texture: 0.03,
        grain: 14.0,
    };
    vec![
        Face { grain: 60.0, ..face([-3000.0, -3000.0, -60.0], [6000.0, 0.0, 0.0], [0.0, 6000.0, 0.0], 0.16) },
        face([-450.0, -350.0, 0.0], [900.0, 0.0, 0.0], [0.0, 700.0, 0.0], 0.34),
        face([low[0], low[1], high[2]], [dx, 0.0, 0.0], [0.0, dy, 0.0], 0.38),
        face(low, [dx, 0.0, 0.0], [0.0, 0.0, dz], 0.26),
        face([low[0], high[1], 0.0], [dx, 0.0, 0.0], [0.0, 0.0, dz], 0.28),
        face(low, [0.0, dy, 0.0], [0.0, 0.0, dz], 0.24),
        face([high[0], low[1], 0.0], [0.0, dy, 0.0], [0.0, 0.0, dz], 0.3),
    ]
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use sightline::decode::{grey, size};
    use sightline::detect::detect;
    use sightline::detection::{Channel, Codes, DetectOptions};
    use sightline::exif;

    #[test]
    fn a_photo_is_a_file_like_any_other_and_its_codes_read_right() {
        let bytes = file(&files()[0]).unwrap();
        assert_eq!(size(&bytes).unwrap().width, 1632);
        assert_eq!(exif::read(&bytes).focal_length_mm, Some(NOMINAL_MM));
        let picture = grey(&bytes, Channel::Grey).unwrap();
        let options = DetectOptions { codes: Codes::Ring14, ..DetectOptions::default() };
        let targets = detect(&picture.view().unwrap(), &options).unwrap().targets;
        let network = network();
        let mut exact = network.clone();
        exact.observations = Source::Exact;
        let truth = simulate(&exact).unwrap();
        let own = truth.observations.iter().filter(|o| o.photo == network.stations[0].id);
        let mut read = 0;
        for o in own.filter(|o| o.point.len() < 3) {
            let near = |t: &&sightline::detection::Target| (t.u - o.u).hypot(t.v - o.v) < 1.0;
            let code = targets.iter().find(near).and_then(|t| t.code);
            assert!(code.is_none_or(|c| c.to_string() == o.point), "{code:?} at {}", o.point);
            read += usize::from(code.is_some());
        }
        assert!(read >= 11, "{read} codes read");
    }

    #[test]
    fn the_project_begins_with_nothing_measured() {
        let project = project().unwrap();
        project.validate().unwrap();
        assert_eq!(project.photos.iter().map(|p| p.file.clone()).collect::<Vec<_>>(), files());
        assert!(project.observations.is_empty() && project.photos.iter().all(|p| p.position.is_none()));
        assert_eq!(project.points.iter().filter(|p| p.role == Role::Control).count(), CONTROL.len());
        assert_eq!(project.distances.len(), 1);
        let network = network();
        let truth = |id: &str| nalgebra::Vector3::from(network.points.iter().find(|p| p.id == id).unwrap().xyz);
        for point in project.points.iter().filter(|p| p.role == Role::Control) {
            let off = (nalgebra::Vector3::from(point.xyz.unwrap()) - truth(&point.id)).norm();
            assert!(off > 0.0 && off < 6.0 * CONTROL_SIGMA_MM, "{} is off by {off}", point.id);
        }
    }
}
