//! Results of VisualSFM (`.nvm`, version 3): cameras, orientations, points with their measurements.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the principal point: the centre of the picture, or cx, cy of `FixedK`; x right, y down. In files that COLMAP writes, the corner of the picture |
//! | axes | camera: x right, y down, z forwards |
//! | rotation | quaternion w x y z, object to camera, and the projection centre |
//! | distortion | measured to ideal: (1 + k ρ² / f²) m = f (X/Z, Y/Z) with ρ the distance of m from the principal point, pixels |
//!
//! Source: C. Wu, VisualSFM documentation ("NVM format"; `[Normalized radial distortion] = [radial distortion] * [focal length]²` in its camera lists), and
//! COLMAP, `reconstruction_io.cc`, `ExportNVM`, which writes the coefficient of its opposite sense with the other sign, and keypoints as they are in its model, from the
//! corner of the picture, without the principal point. Such a file has no negative measurement, and its measurements differ from the images of its points by one shift, which
//! is the principal point; half of the picture is the same shift. Blanks of a file name stand as
//! quotation marks. The file has no size of the picture: see [`bal`](super::bal). The first model is read; further models, colours and the numbers
//! of features are counted. Photos are named by their files, points by their places from 0.

use std::collections::HashMap;

use nalgebra::Vector3;

use super::bal::{self, Words};
use super::foreign::{Assumed, ForeignCamera, ForeignModel, Pose};
use super::network::{self, ForeignNetwork};
use sightline::error::Result;
use sightline::project::{Camera, Interior, Parameter, Point};

/// Whether a text is of this format.
pub fn recognises(text: &str) -> bool {
    text.trim_start().starts_with("NVM_V3")
}

/// The first line's calibration that all photos share: f, cx, cy.
fn fixed(line: &str, words: &mut Words<'_>) -> Result<Option<[f64; 3]>> {
    words.word("NVM_V3")?;
    if line.split_whitespace().nth(1) != Some("FixedK") {
        return Ok(None);
    }
    words.word("FixedK")?;
    let [fx, cx, fy, cy] = words.numbers("fx, cx, fy, cy of FixedK")?;
    // How measurements are scaled where they differ is nowhere stated.
    if !(fx > 0.0 && (fx - fy).abs() <= 1e-9 * fx) {
        return Err(words.wrong("fx above 0 and equal to fy", &format!("{fx} {fy}")));
    }
    Ok(Some([fx, cx, cy]))
}

/// A result.
///
/// # Errors
/// [`Error::Invalid`](sightline::error::Error::Invalid) with the line and what was expected there.
pub fn read(text: &str) -> Result<ForeignNetwork> {
    let mut words = Words::new(text);
    let mut network = ForeignNetwork::default();
    let fixed = fixed(text.trim_start().lines().next().unwrap_or_default(), &mut words)?;
    let count = words.whole("a number of cameras", usize::MAX)?;
    let mut photos: Vec<(String, [f64; 2], Pose)> = Vec::new();
    let mut named: HashMap<String, usize> = HashMap::new();
    for _ in 0..count {
        let file = words.word("a file name")?.replace('"', " ");
        let [f, qw, qx, qy, qz, x, y, z, k, _] = words.numbers("f, quaternion, centre, distortion, 0 of a camera")?;
        if !(f > 0.0) {
            return Err(words.wrong("a focal length above 0", &f.to_string()));
        }
        let rotation = Pose::of_quaternion([qw, qx, qy, qz], [0.0; 3]);
        let pose = rotation.and_then(|pose| Pose::at(pose.rotation, [x, y, z]));
        let pose = pose.ok_or_else(|| words.wrong("a quaternion", &format!("{qw} {qx} {qy} {qz}")))?;
        let file = file.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
        let times = named.entry(file.clone()).or_default();
        *times += 1;
        // Two folders may have a file of the same name.
        let name = if *times == 1 { file } else { format!("{file} ({times})") };
        photos.push((name, [f, k / (f * f)], pose));
    }
    let points = words.whole("a number of points", usize::MAX)?;
    let mut measured = Vec::new();
    for k in 0..points {
        let xyz = words.numbers("X, Y, Z of a point")?;
        words.numbers::<3>("the colour of a point")?;
        network.points.push(Point { id: k.to_string(), xyz: Some(xyz), ..Point::default() });
        for _ in 0..words.whole("a number of measurements", usize::MAX)? {
            let photo = words.whole(&format!("a photo from 0, fewer than {count}"), count)?;
            words.whole("the number of a feature", usize::MAX)?;
            measured.push((photo, k, words.numbers::<2>("the measurement x, y")?));
        }
    }
    let further = words.rest().first().is_some_and(|word| word.parse::<usize>().is_ok_and(|count| count > 0));
    network.notes.ignore("further models", usize::from(further));
    network.notes.ignore("colours of points", points);
    let corners = fixed.is_none().then(|| principal_point_of_corners(&photos, &network.points, &measured)).flatten();
    let (size, centre) = match (fixed, corners) {
        (Some([_, cx, cy]), _) => {
            network.notes.assume(Assumed::ImageSizeFromPrincipalPoint);
            let side = |c: f64| (2.0 * c).round().clamp(1.0, 1e6) as u32;
            ([side(cx), side(cy)], [cx, cy])
        }
        (None, Some(centre)) => {
            network.notes.assume(Assumed::MeasurementsFromCorner);
            // From here on they count from the principal point, as those of other files do.
            measured.iter_mut().for_each(|(.., [x, y])| (*x, *y) = (*x - centre[0], *y - centre[1]));
            (centre.map(|c| (2.0 * c).round().clamp(1.0, 1e6) as u32), centre)
        }
        (None, None) => {
            network.notes.assume(Assumed::ImageSizeFromMeasurements);
            let size = bal::size(measured.iter().map(|(.., pixel)| *pixel));
            (size, size.map(|side| f64::from(side) / 2.0))
        }
    };
    for (name, [f, k], pose) in &photos {
        let f = fixed.map_or(*f, |fixed| fixed[0]);
        let camera = camera(&mut network, [f, *k], size, centre);
        network.photos.push(network::photo(name.clone(), camera, name, Some(*pose)));
    }
    for (photo, point, [x, y]) in measured {
        let pixel = [centre[0] + x, centre[1] + y];
        network.observations.push(network::observation(&photos[photo].0, &point.to_string(), pixel));
    }
    network.notes.assume(Assumed::SigmaOnePixel);
    Ok(network)
}

/// Measurements that a principal point is taken from, at least.
const FEWEST: usize = 8;
/// Share of the largest measurement that a principal point has at least: it is half of it where measurements fill the picture, and 0 where
/// they are from the principal point.
const LEAST: f64 = 0.25;

/// The principal point of a file whose measurements are from the corner of the picture: their median difference from the images of their points.
fn principal_point_of_corners(
    photos: &[(String, [f64; 2], Pose)],
    points: &[Point],
    measured: &[(usize, usize, [f64; 2])],
) -> Option<[f64; 2]> {
    if measured.len() < FEWEST || measured.iter().any(|(.., [x, y])| !(*x >= 0.0 && *y >= 0.0)) {
        return None;
    }
    let differences = measured.iter().filter_map(|(photo, point, [x, y])| {
        let (_, [f, _], pose) = &photos[*photo];
        let at = pose.rotation * (Vector3::from(points[*point].xyz?) - Vector3::from(pose.position));
        let difference = [x - f * at.x / at.z, y - f * at.y / at.z];
        (at.z > 0.0 && difference.iter().all(|d| d.is_finite())).then_some(difference)
    });
    let differences: Vec<[f64; 2]> = differences.collect();
    let median = |k: usize| {
        let mut values: Vec<f64> = differences.iter().map(|d| d[k]).collect();
        let middle = values.len() / 2;
        (values.len() >= FEWEST).then(|| *values.select_nth_unstable_by(middle, f64::total_cmp).1)
    };
    let centre = [median(0)?, median(1)?];
    let largest = |k: usize| measured.iter().map(|(.., pixel)| pixel[k]).fold(0.0, f64::max);
    (0..2).all(|k| centre[k] >= LEAST * largest(k) && centre[k] < 5e5).then_some(centre)
}

/// The camera of these parameters: that of the photo before where it is the same, else a new one.
fn camera(network: &mut ForeignNetwork, [f, k]: [f64; 2], size: [u32; 2], centre: [f64; 2]) -> String {
    let number = (network.cameras.len() + 1).to_string();
    let mut camera = Camera::new(number.clone(), size[0], size[1], Interior::brown(f));
    camera.interior.set(Parameter::K1, k);
    // Our y of a photo points up, and the centre is the picture's.
    camera.interior.set(Parameter::X0, centre[0] - f64::from(size[0]) / 2.0);
    camera.interior.set(Parameter::Y0, f64::from(size[1]) / 2.0 - centre[1]);
    if let Some(last) = network.cameras.last()
        && matches!(&last.model, ForeignModel::Correction(known, None) if known.interior == camera.interior)
    {
        return last.id.clone();
    }
    let model = ForeignModel::Correction(camera, None);
    network.cameras.push(ForeignCamera { id: number.clone(), size, model, pose: None, region: None, covariance: None });
    number
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::camera::pixel_from_camera_point;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const FILE: &str = "NVM_V3 \n\n2\n\
        a\"b.jpg\t1000 1 0 0 0 0 0 -5 0.1 0\n\
        dir/c.jpg 1000 0 1 0 0 1 2 3 0.1 0\n\n\
        1\n0.5 -1 0 255 0 0 2 0 7 99.019607 -198.039215 1 3 -320.5 200.25\n\n0\n";

    /// Computed by hand: photo a is at (0, 0, -5) and looks along z. X = (0.5, -1, 0) has X/Z = 0.1, Y/Z = -0.2, so (1 + k ρ²/f²) m = (100, -200). The ray's ρ²/f² is s² 0.05
    /// with m = s (100, -200): (1 + 0.1 · 0.05 s²) s = 1 at s = 0.9950735…
    #[test]
    fn a_point_by_hand_has_its_measurement() {
        let network = read(FILE).unwrap();
        assert_eq!(network.photos[0].id, "a b.jpg");
        assert_eq!(network.photos[1].position, Some([1.0, 2.0, 3.0]));
        assert_eq!((network.cameras.len(), network.cameras[0].size), (1, [642, 402]));
        let ForeignModel::Correction(camera, None) = &network.cameras[0].model else { panic!("a camera of ours") };
        // Our camera looks along -z with y up.
        let pixel = pixel_from_camera_point(camera, Vector3::new(0.5, 1.0, -5.0)).unwrap();
        let s = 0.995_073_533_543_6;
        assert!(
            (pixel[0] - (321.0 + 100.0 * s)).abs() < 1e-6 && (pixel[1] - (201.0 - 200.0 * s)).abs() < 1e-6,
            "{pixel:?}"
        );
        let seen = &network.observations[0];
        assert!((seen.u - (321.0 + 99.019_607)).abs() < 1e-12 && (seen.v - (201.0 - 198.039_215)).abs() < 1e-12);
        // Rotated by half a turn about x: y down becomes y up, and it looks along -z.
        let photo = &network.photos[1];
        assert!(photo.rotation.unwrap().iter().all(|angle| angle.abs() < 1e-12), "{:?}", photo.rotation);
    }

    /// As COLMAP writes it: keypoints from the corner of a picture of 1280 x 960. X/Z and Y/Z of the point k are (k - 5) / 10 and (k - 3) / 20, and f = 900.
    #[test]
    fn measurements_from_the_corner_have_their_principal_point() {
        let point = |k: usize, [cx, cy]: [f64; 2]| {
            let (x, y) = (0.1 * (k as f64 - 5.0), 0.05 * (k as f64 - 3.0));
            format!("{} {} 5 1 2 3 1 0 {k} {} {}\n", 5.0 * x, 5.0 * y, cx + 900.0 * x, cy + 900.0 * y)
        };
        let file = |centre: [f64; 2]| {
            let points: String = (0..10).map(|k| point(k, centre)).collect();
            format!("NVM_V3 \n\n1\na.jpg 900 1 0 0 0 0 0 0 0 0\n\n10\n{points}")
        };
        let network = read(&file([640.0, 480.0])).unwrap();
        assert_eq!(network.cameras[0].size, [1280, 960]);
        assert!(network.notes.assumed.contains(&Assumed::MeasurementsFromCorner));
        let ForeignModel::Correction(camera, None) = &network.cameras[0].model else { panic!("a camera of ours") };
        for (k, seen) in network.observations.iter().enumerate() {
            let (x, y) = (0.1 * (k as f64 - 5.0), 0.05 * (k as f64 - 3.0));
            let [u, v] = pixel_from_camera_point(camera, Vector3::new(x, -y, -1.0)).unwrap();
            assert!((u - seen.u).abs() < 1e-9 && (v - seen.v).abs() < 1e-9, "{k}: {u} {v} for {seen:?}");
            assert!((seen.u - (640.0 + 900.0 * x)).abs() < 1e-9 && (seen.v - (480.0 + 900.0 * y)).abs() < 1e-9);
        }
        // From the principal point, some are negative.
        let network = read(&file([0.0, 0.0])).unwrap();
        assert_eq!(network.cameras[0].size, [902, 542]);
        // A principal point off the middle of the picture is kept.
        let network = read(&file([650.25, 470.5])).unwrap();
        let ForeignModel::Correction(camera, None) = &network.cameras[0].model else { panic!("a camera of ours") };
        let [u, v] = pixel_from_camera_point(camera, Vector3::new(0.0, 0.0, -1.0)).unwrap();
        assert!((u - 650.25).abs() < 1e-9 && (v - 470.5).abs() < 1e-9, "{u} {v}");
    }

    #[test]
    fn damage_names_its_line() {
        for (from, to, line) in [
            ("1000 1 0 0 0", "-1 1 0 0 0", 4),
            ("2 0 7", "2 9 7", 8),
            ("1 3 -320.5", "1 x -320.5", 8),
            ("NVM_V3 ", "NVM_V3 FixedK 900 320 910 240", 1),
        ] {
            let error = read(&FILE.replace(from, to)).unwrap_err();
            assert_eq!(error.place().line, Some(line), "{to}: {error}");
        }
        let fixed = read(&FILE.replace("NVM_V3 ", "NVM_V3 FixedK 900 320 900 240")).unwrap();
        assert_eq!(fixed.cameras[0].size, [640, 480]);
    }
}
