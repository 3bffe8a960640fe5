//! Calibrated cameras of Pix4D (`PROJECT_calibrated_camera_parameters.txt`): cameras and orientations.
//!
//! | convention | here |
//! | --- | --- |
//! | pixel origin | the file does not say where in the upper left pixel: its corner, ours |
//! | axes | camera: x right, y down, z forwards: m = K [R \| −R t] X |
//! | rotation | matrix by rows, object to camera, and the projection centre t |
//! | distortion | ideal to image: three radial coefficients, two tangential T1, T2 as OpenCV's p1, p2 |
//!
//! Source: the head of the file itself, and Pix4D, "How are the Internal and External Camera Parameters defined?". Coordinates are less the offset of
//! `PROJECT_offset.xyz`, which is another file. There are no points and no measurements in it.

use nalgebra::Matrix3;

use super::bal::Words;
use super::foreign::{Assumed, ForeignCamera, ForeignModel, LONGEST_SIDE, Pose};
use super::lens::{Lens, LensModel, term::*};
use super::network::{self, ForeignNetwork};
use sightline::error::Result;

static PIX4D: LensModel = LensModel {
    name: "pix4d",
    equidistant: false,
    parameters: &[
        ("fx", &[FX]),
        ("fy", &[FY]),
        ("skew", &[SKEW]),
        ("cx", &[CX]),
        ("cy", &[CY]),
        ("R1", &[K1]),
        ("R2", &[K2]),
        ("R3", &[K3]),
        ("T1", &[P1]),
        ("T2", &[P2]),
    ],
};

/// Content of the first line of the header.
const HEAD: &str = "fileName imageWidth imageHeight";
/// Content of its last line.
const MODEL: &str = "camera model m = K [R|-Rt] X";

/// Whether a text is of this format.
pub fn recognises(text: &str) -> bool {
    text.trim_start().starts_with(HEAD) && text.lines().take(12).any(|line| line.trim() == MODEL)
}

/// Cameras and photos.
///
/// # Errors
/// [`Error::Invalid`](sightline::error::Error::Invalid) with the line and what was expected there.
pub fn read(text: &str) -> Result<ForeignNetwork> {
    let mut network = ForeignNetwork::default();
    let head = text.lines().position(|line| line.trim() == MODEL).map_or(0, |line| line + 1);
    // Lines of the head are blanked, so that the others keep their numbers.
    let body: String =
        text.lines().enumerate().map(|(k, line)| if k < head { "\n".into() } else { format!("{line}\n") }).collect();
    let mut words = Words::new(&body);
    while let Some(file) = words.next_word() {
        let file = file.to_owned();
        let size = [(); 2].map(|()| words.whole("width and height in pixels", LONGEST_SIDE as usize));
        let [width, height] = size;
        let size = [width?.max(1) as u32, height?.max(1) as u32];
        let [fx, skew, cx, zero, fy, cy, below, beside, one] =
            words.numbers("the camera matrix, three rows of three")?;
        if !(fx > 0.0 && fy > 0.0 && [zero, below, beside] == [0.0; 3] && one == 1.0) {
            return Err(
                words.wrong("a camera matrix fx s cx, 0 fy cy, 0 0 1", &format!("{fx} {skew} {cx} {zero} {fy}"))
            );
        }
        let [r1, r2, r3] = words.numbers("three radial coefficients")?;
        let [t1, t2] = words.numbers("two tangential coefficients")?;
        let position: [f64; 3] = words.numbers("the position of the camera")?;
        let rotation: [f64; 9] = words.numbers("the rotation of the camera, three rows of three")?;
        let pose = Pose::at(Matrix3::from_row_slice(&rotation), position);
        let pose = pose.ok_or_else(|| words.wrong("a rotation", &format!("{rotation:?}")))?;
        let lens = PIX4D.lens(&Lens::default(), &[fx, fy, skew, cx, cy, r1, r2, r3, t1, t2]);
        let known = network.cameras.iter().rev().find(|camera| {
            camera.size == size && matches!(&camera.model, ForeignModel::Lens(_, other) if *other == lens)
        });
        let camera = match known {
            Some(known) => known.id.clone(),
            None => {
                let id = (network.cameras.len() + 1).to_string();
                network.cameras.push(ForeignCamera::new(id.clone(), size, &PIX4D, lens));
                id
            }
        };
        network.photos.push(network::photo(file.clone(), camera, &file, Some(pose)));
    }
    if network.photos.is_empty() {
        return Err(words.wrong("a photo", "the end of the file"));
    }
    network.notes.assume(Assumed::PixelOriginCorner);
    Ok(network)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const FILE: &str = "fileName imageWidth imageHeight\ncamera matrix K [3x3]\nradial distortion [3x1]\ntangential distortion [2x1]\n\
        camera position t [3x1]\ncamera rotation R [3x3]\ncamera model m = K [R|-Rt] X\n\n\
        a.JPG 4608 3456\n3600 0 2300\n0 3600 1720\n0 0 1\n-0.1 0.02 0\n0.001 -0.002\n10 20 30\n1 0 0\n0 -1 0\n0 0 -1\n\
        b.JPG 4608 3456\n3600 0 2300\n0 3600 1720\n0 0 1\n-0.1 0.02 0\n0.001 -0.002\n11 20 30\n1 0 0\n0 -1 0\n0 0 -1\n";

    /// By hand: a camera at (10, 20, 30) that looks down sees X = (10.5, 21, 26) at a = 0.125, b = -0.25: the distortion of that direction is the one worked out in `opensfm`, so
    /// a' = 0.1237574462890625, b' = -0.247749267578125 and u = 3600 a' + 2300, v = 3600 b' + 1720.
    #[test]
    fn a_point_by_hand_has_its_pixel() {
        let network = read(FILE).unwrap();
        assert_eq!((network.cameras.len(), network.photos.len()), (1, 2));
        let ForeignModel::Lens(_, lens) = &network.cameras[0].model else { panic!("a lens") };
        let photo = &network.photos[0];
        let pose = Pose::of(photo.position.unwrap(), photo.rotation.unwrap());
        let p = pose.rotation * nalgebra::Vector3::new(0.5, 1.0, -4.0);
        let pixel = lens.project([p.x / p.z, p.y / p.z]).unwrap();
        let by_hand = [3600.0 * 0.123_757_446_289_062_5 + 2300.0, 3600.0 * -0.247_749_267_578_125 + 1720.0];
        assert!((pixel[0] - by_hand[0]).hypot(pixel[1] - by_hand[1]) < 1e-8, "{pixel:?} {by_hand:?}");
    }

    #[test]
    fn damage_names_its_line() {
        for (from, to, line) in [
            ("3600 0 2300\n0 3600", "3600 0 2300\n1 3600", 12),
            ("11 20 30\n1 0 0", "11 20 30\n2 0 0", 28),
            ("0 0 -1\nb.JPG", "0 0\nb.JPG", 19),
        ] {
            let error = read(&FILE.replacen(from, to, 1)).unwrap_err();
            assert_eq!(error.place().line, Some(line), "{to}: {error}");
        }
        assert!(recognises(FILE) && !recognises("fileName imageWidth imageHeight\n1 2 3\n"));
    }
}
