#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use crate::camera::ideal_from_pixel;
use crate::camera::pixel_from_camera_point;
use crate::noise::Noise;
use crate::project::Interior;
use crate::project::Photo;

const CENTRE: [f64; 2] = [2004.0, 1496.0];
const CORNER: f64 = 2500.0;

/// A camera with the distortion of a wide lens and its principal point off the middle, in millimetres.
fn brown() -> Camera {
    let mut camera = Camera::new("k", 4000, 3000, Interior::brown(16.0));
    camera.pixel_pitch = Some([0.004; 2]);
    for (p, value) in [(Parameter::X0, 0.12), (Parameter::Y0, -0.08), (Parameter::K1, 3e-4), (Parameter::P1, 2e-5)] {
        camera.interior.set(p, value);
    }
    camera
}

/// The same lens in pixels, its photo coordinates being pixels.
fn pixels() -> Camera {
    let mut camera = Camera::new("k", 4000, 3000, Interior::brown(4000.0));
    for (p, value) in [(Parameter::X0, 30.0), (Parameter::Y0, -20.0), (Parameter::K1, 4.8e-9), (Parameter::P1, 8e-8)] {
        camera.interior.set(p, value);
    }
    camera
}

fn opencv() -> Camera {
    let (fx, fy) = (Some(3000.0), Some(3010.0));
    let (k1, k2, p1, p2, k3) = (-0.12, 0.03, 1e-3, -5e-4, 0.0);
    Camera::new("k", 4000, 3000, Interior::Opencv { fx, fy, cx: 2030.0, cy: 1480.0, k1, k2, p1, p2, k3 })
}

const X: [f64; 4] = [0.12, -0.07, 1.6, -1.1];

fn shift(x: [f64; 4], sigma: f64) -> ColourShift {
    let mut covariance = [0.0; 10];
    for k in [0, 4, 7, 9] {
        covariance[k] = sigma * sigma;
    }
    let (shift, covariance) = (Some([x[0], x[1]]), Some(covariance));
    ColourShift { linear: x[2], cubic: x[3], sigma, targets: 100, shift, covariance, ..ColourShift::default() }
}

fn photo(id: &str, x: [f64; 4], sigma: f64) -> PhotoColours {
    PhotoColours { photo: id.into(), corner: CORNER, centre: Some(CENTRE), red: Some(shift(x, sigma)), blue: None }
}

/// Largest distance in pixels, over the picture, of the set's image of a ray from where the other colour was measured.
fn off(camera: &Camera, set: &BTreeMap<LensColour, ColourDifferences>, x: [f64; 4]) -> f64 {
    let mut red = camera.clone();
    red.colours = set.clone();
    let red = red.of_photo(&Photo { colour: Some(LensColour::Red), ..Photo::default() });
    let mut most = 0.0f64;
    for k in 0..400u32 {
        let green = [f64::from(k % 20) * 210.0 + 5.0, f64::from(k / 20) * 157.0 + 8.0];
        let by = by_numbers(green, CENTRE, CORNER);
        let x = Vector4::from(x);
        let wanted = [green[0] + by[0].dot(&x), green[1] + by[1].dot(&x)];
        let [a, b] = ideal_from_pixel(camera, green).expect("a ray");
        let found = pixel_from_camera_point(&red, nalgebra::Vector3::new(a, b, -1.0)).expect("an image");
        most = most.max((found[0] - wanted[0]).hypot(found[1] - wanted[1]));
    }
    most
}

#[test]
fn both_models_image_the_colour_where_it_was_measured() {
    for camera in [brown(), pixels(), opencv()] {
        let set = colour_differences(&camera, &[photo("1", X, 0.01)]).expect("a set");
        let left = off(&camera, &set, X);
        assert!(left < 0.01, "{left} px is left of {:?}", camera.interior);
        // without the set it would be this far off
        assert!(off(&camera, &BTreeMap::new(), X) > 0.4);
        assert!(!set.contains_key(&LensColour::Blue));
    }
}

#[test]
fn what_moves_no_place_is_left_out() {
    let [cx, cy] = CENTRE;
    let (fx, fy) = (Some(3000.0), Some(3000.0));
    let pinhole = Interior::Opencv { fx, fy, cx, cy, k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 };
    let pinhole = Camera::new("k", 4000, 3000, pinhole);
    for (camera, distance) in [(&pinhole, Parameter::F), (&brown(), Parameter::C), (&opencv(), Parameter::F)] {
        let set = colour_differences(camera, &[photo("1", X, 0.01)]).expect("a set");
        let red = &set[&LensColour::Red];
        assert!(red.parameters.keys().eq(red.sigma.keys()));
        assert!(red.parameters.contains_key(&distance) && red.parameters.contains_key(&Parameter::K1));
        for p in [Parameter::K2, Parameter::K3, Parameter::P1, Parameter::P2] {
            let Some(value) = red.parameters.get(&p) else { continue };
            // without it some place is imaged elsewhere; the others may take most of that
            let mut without = set.clone();
            without.get_mut(&LensColour::Red).expect("red").parameters.remove(&p);
            let moved = off(camera, &without, X);
            assert!(moved > 0.0009, "{p} of {value} moves {moved} px");
        }
        if camera.interior == pinhole.interior {
            let names: Vec<_> = red.parameters.keys().copied().collect();
            assert!(!names.contains(&Parameter::P1) && !names.contains(&Parameter::P2), "{names:?}");
        }
        assert!(off(camera, &set, X) < 0.01);
    }
    // a lens of one distortion for all colours that only shifts: nothing but the principal point has a share
    let shifted = colour_differences(&brown(), &[photo("1", [0.1, 0.0, 0.0, 0.0], 0.01)]).expect("a set");
    assert!(!shifted[&LensColour::Red].parameters.contains_key(&Parameter::K3));
}

#[test]
fn millimetres_and_pixels_say_the_same() {
    let of =
        |camera: &Camera| colour_differences(camera, &[photo("1", X, 0.01)]).expect("a set").remove(&LensColour::Red);
    let (mm, px) = (of(&brown()).expect("red"), of(&pixels()).expect("red"));
    for (p, power) in [(Parameter::C, 1), (Parameter::X0, 1), (Parameter::K1, -2), (Parameter::P1, -1)] {
        let factor = 0.004f64.powi(power);
        for (mm, px) in [(mm.parameters[&p], px.parameters[&p]), (mm.sigma[&p], px.sigma[&p])] {
            assert!((mm / factor - px).abs() < 1e-4 * px.abs(), "{p}: {mm} {px}");
        }
    }
}

#[test]
fn standard_errors_are_the_scatter() {
    let camera = brown();
    let mut random = Noise::new(5, 0);
    let sets: Vec<ColourDifferences> = (0..200)
        .map(|_| {
            let noisy = X.map(|x| x + 0.02 * random.normal());
            colour_differences(&camera, &[photo("1", noisy, 0.02)])
                .expect("a set")
                .remove(&LensColour::Red)
                .expect("red")
        })
        .collect();
    // one whose effect is about the least that counts is in some of the sets only
    let in_all = sets[0].sigma.iter().filter(|(p, _)| sets.iter().all(|set| set.parameters.contains_key(p)));
    let in_all: BTreeMap<_, _> = in_all.collect();
    assert!([Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1].iter().all(|p| in_all.contains_key(p)));
    for (p, sigma) in in_all {
        let values = sets.iter().map(|set| set.parameters[p]);
        let mean = values.clone().sum::<f64>() / 200.0;
        let scatter = (values.map(|x| (x - mean).powi(2)).sum::<f64>() / 199.0).sqrt();
        assert!((0.8..1.25).contains(&(scatter / sigma)), "{p}: {scatter} for {sigma}");
    }
}

#[test]
fn photos_are_averaged_by_their_weights_and_disagreement_widens() {
    let camera = brown();
    let red = |photos: &[PhotoColours]| {
        colour_differences(&camera, photos).expect("a set").remove(&LensColour::Red).expect("red")
    };
    let [mut a, mut b] = [X, X];
    (a[2], b[2]) = (1.5, 1.7);
    let one = red(&[photo("1", X, 0.1)]);
    let alike = red(&[photo("1", X, 0.1), photo("2", X, 0.1)]);
    let c = |set: &ColourDifferences| (set.parameters[&Parameter::C], set.sigma[&Parameter::C]);
    assert!((c(&alike).0 - c(&one).0).abs() < 1e-12 && (c(&alike).1 * 2f64.sqrt() / c(&one).1 - 1.0).abs() < 1e-9);
    let near_a = red(&[photo("1", a, 0.01), photo("2", b, 0.1)]);
    let at_a = red(&[photo("1", a, 0.01)]);
    assert!((c(&near_a).0 - c(&at_a).0).abs() < 0.02 * (c(&red(&[photo("2", b, 0.1)])).0 - c(&at_a).0).abs());
    let apart = red(&[photo("1", a, 0.01), photo("2", b, 0.01)]);
    // 0.2 px between them where 0.014 px is expected: of four degrees of freedom one has it all
    assert!(c(&apart).1 > 4.0 * c(&red(&[photo("1", X, 0.01), photo("2", X, 0.01)])).1);
}

#[test]
fn what_cannot_be_told_is_refused() {
    let told =
        |camera: &Camera, photos: &[PhotoColours]| match colour_differences(camera, photos).expect_err("a reason") {
            Error::Invalid { reason, .. } => reason,
            error => panic!("{error}"),
        };
    let good = photo("1", X, 0.01);
    assert_eq!(told(&brown(), &[]), Reason::NoColoursMeasured);
    // a document of before: no shift, no covariance
    let before =
        PhotoColours { red: Some(ColourShift { shift: None, covariance: None, ..shift(X, 0.01) }), ..good.clone() };
    assert_eq!(told(&brown(), &[before]), Reason::NoColoursMeasured);
    let other = PhotoColours { corner: 3000.0, photo: "2".into(), ..good.clone() };
    assert_eq!(told(&brown(), &[good.clone(), other]), Reason::ColoursOfAnotherGrid { photo: "2".into() });
    let mut unknown = brown();
    if let Interior::Brown { c, .. } = &mut unknown.interior {
        *c = None;
    }
    assert_eq!(told(&unknown, std::slice::from_ref(&good)), Reason::ColoursWithoutDistance);
    let mut folded = opencv();
    folded.interior.set(Parameter::K1, -1.2);
    assert!(matches!(told(&folded, &[good]), Reason::ColoursBeyondModel { .. }));
}
