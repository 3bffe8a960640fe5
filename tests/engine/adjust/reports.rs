//! Comparison with DBAT's reports of its camera calibration, to their printed digits: sigma0, redundancy, the camera and all photos.
//!
//! Model 1 is our Brown model: it corrects the measured point, without affinity. The forward model distorts the ideal point in millimetres:
//! x + x(K1 r² + …) with the printed signs reversed, which is the opencv model with fx = fy, k1 = -K1 c², k2 = -K2 c⁴,
//! k3 = -K3 c⁶, p2 = -P1 c and p1 = P2 c (y points the other way). Model 3 is our model with the affinity of the report applied to the
//! pixel pitch.

use super::published::{DISTORTED, HEIGHT_MM, camcal};
use crate::support::data;
use sightline::adjust::adjust;
use sightline::adjustment::{AdjustOptions, Adjustment, ResidualPlace, Termination};
use sightline::project::{Interior, Parameter, Project, Sigma};

/// A printed number: value, half a unit of its last digit, standard error (0 if it is held).
#[derive(Clone, Copy, Debug, Default)]
struct Printed {
    value: f64,
    half: f64,
    deviation: f64,
}

/// Contents of a report.
struct Report {
    sigma0: Printed,
    redundancy: usize,
    /// Camera parameters with the first word of their headings.
    camera: Vec<(String, Printed)>,
    /// Omega, phi, kappa in degrees, X, Y, Z.
    photos: Vec<[Printed; 6]>,
}

fn printed(text: &str) -> Printed {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    let exponent: i32 = exponent.parse().expect("an exponent");
    Printed { value: text.parse().expect("a number"), half: 0.5 * 10f64.powi(exponent - decimals), deviation: 0.0 }
}

fn report(name: &str) -> Option<Report> {
    let text = data::text(&format!("camcal/reports/camcal-dbatreport-{name}.txt"))?;
    let after = |label: &str| {
        let line = text.lines().find(|line| line.trim().starts_with(label)).expect("in the report");
        line.trim()[label.len()..].trim().to_owned()
    };
    let (mut camera, mut photos) = (Vec::new(), Vec::new());
    let (mut heading, mut of_photos) = (String::new(), false);
    for line in text.lines().map(str::trim) {
        of_photos |= line.starts_with("Photograph Standard Deviations");
        let list: &mut Vec<(String, Printed)> = if of_photos { &mut photos } else { &mut camera };
        if let Some(value) = line.strip_prefix("Value:") {
            list.push((heading.clone(), printed(value.split_whitespace().next().expect("a value"))));
        } else if let Some(deviation) = line.strip_prefix("Deviation:") {
            let deviation = deviation.split_whitespace().next().expect("a value").parse().expect("a number");
            list.last_mut().expect("a value stands before").1.deviation = deviation;
        } else if line.ends_with(':') {
            if line.starts_with("Quality") || line.starts_with("Photo quality") {
                break;
            }
            heading = line.split([' ', ':']).next().unwrap_or_default().to_owned();
        }
    }
    let wanted = ["Omega", "Phi", "Kappa", "Xc", "Yc", "Zc"];
    photos.retain(|(name, _)| wanted.contains(&name.as_str()));
    assert!(photos.iter().zip(wanted.iter().cycle()).all(|((name, _), wanted)| name == wanted));
    let photos = photos.chunks_exact(6).map(|six| std::array::from_fn(|k| six[k].1)).collect();
    let redundancy = after("Redundancy").parse().expect("a number");
    Some(Report { sigma0: printed(&after("Sigma0:")), redundancy, camera, photos })
}

impl Report {
    fn of_camera(&self, name: &str) -> Printed {
        self.camera.iter().find(|(heading, _)| heading == name).expect("in the report").1
    }

    /// sigma0 to its printed digits, for an adjustment with this many more unknowns.
    fn has_sigma0(&self, adjustment: &Adjustment, held: usize) {
        assert_eq!(adjustment.termination, Termination::Converged);
        assert_eq!(adjustment.redundancy, self.redundancy + held);
        let more = (adjustment.redundancy as f64 / self.redundancy as f64).sqrt();
        let sigma0 = adjustment.sigma0.expect("redundant") * more;
        assert!((sigma0 - self.sigma0.value).abs() <= self.sigma0.half, "{sigma0} is not {:?}", self.sigma0);
    }

    /// Every photo within a twentieth of its standard errors, and these, of `sigmas`, within a hundredth.
    fn has_photos(&self, values: &Adjustment, sigmas: &Adjustment) {
        assert_eq!((self.photos.len(), values.photos.len()), (21, 21));
        for ((photo, stated), known) in values.photos.iter().zip(&sigmas.photos).zip(&self.photos) {
            let (sigma, turned) = (stated.sigma_position.expect("full"), stated.sigma_rotation.expect("full"));
            for k in 0..3 {
                let turn = photo.rotation[k].to_degrees() - known[k].value;
                let turn = turn - (turn / 360.0).round() * 360.0;
                agrees(&format!("angle {k} of {}", photo.id), turn, turned[k].to_degrees(), known[k]);
                let shift = photo.position[k] - known[3 + k].value;
                agrees(&format!("coordinate {k} of {}", photo.id), shift, sigma[k], known[3 + k]);
            }
        }
    }
}

/// A difference within 0.05 standard errors and the printed digits, a standard error within 1 %.
fn agrees(what: &str, difference: f64, sigma: f64, known: Printed) {
    let limit = 0.05 * known.deviation + known.half;
    assert!(difference.abs() <= limit, "{what} differs by {difference}, {} sigmas", difference / known.deviation);
    let ratio = sigma / known.deviation;
    assert!((ratio - 1.0).abs() <= 0.01, "sigma of {what}: {sigma} against {}", known.deviation);
}

fn solve(project: &Project) -> Adjustment {
    let options = AdjustOptions { residuals: ResidualPlace::Corrected, ..AdjustOptions::default() };
    let adjustment = adjust(project, &options, &mut |_| true).expect("solvable");
    super::published::nothing_is_asked(&adjustment);
    adjustment
}

const NAMES: [&str; 8] = ["Camera", "px", "py", "K1", "K2", "K3", "P1", "P2"];

#[test]
fn model_1_is_reproduced_to_its_printed_digits() {
    let (Some(project), Some(report)) = (camcal("camcal-pmexport.txt", &DISTORTED), report("model1")) else { return };
    let adjustment = solve(&project);
    report.has_sigma0(&adjustment, 0);
    assert_eq!((adjustment.observations_count, adjustment.unknowns), (4148, 422));
    let camera = &adjustment.cameras[0];
    let half_width = HEIGHT_MM / 1704.0 * 2272.0 / 2.0;
    for (parameter, name) in DISTORTED.into_iter().zip(NAMES) {
        let known = report.of_camera(name);
        let value = camera.camera.interior.get(parameter).expect("of the model");
        // In the report the principal point is relative to the top left corner.
        let value = match parameter {
            Parameter::X0 => half_width + value,
            Parameter::Y0 => HEIGHT_MM / 2.0 - value,
            _ => value,
        };
        agrees(name, value - known.value, camera.sigma[&parameter], known);
    }
    report.has_photos(&adjustment, &adjustment);
    let at = |name| camera.correlation.names.iter().position(|n| n == name).expect("estimated");
    let correlation = camera.correlation.matrix[at("k2")][at("k3")];
    assert!((correlation + 0.979).abs() <= 5e-4, "{correlation}");
}

#[test]
fn the_forward_model_is_the_opencv_model_to_its_printed_digits() {
    let free = [
        Parameter::F,
        Parameter::Cx,
        Parameter::Cy,
        Parameter::K1,
        Parameter::K2,
        Parameter::K3,
        Parameter::P2,
        Parameter::P1,
    ];
    let (Some(mut project), Some(report)) = (camcal("camcal-pmexport.txt", &free), report("model-1")) else { return };
    let pitch = HEIGHT_MM / 1704.0;
    let f = Some(7.3 / pitch);
    project.cameras[0].interior =
        Interior::Opencv { fx: f, fy: f, cx: 1136.0, cy: 852.0, k1: 0.0, k2: 0.0, p1: 0.0, p2: 0.0, k3: 0.0 };
    let adjustment = solve(&project);
    report.has_sigma0(&adjustment, 0);
    assert_eq!((adjustment.observations_count, adjustment.unknowns), (4148, 422));
    let camera = &adjustment.cameras[0];
    let value = |parameter| camera.camera.interior.get(parameter).expect("of the model");
    let c = value(Parameter::F) * pitch;
    let at = |p: Parameter| camera.correlation.names.iter().position(|n| n == p.name()).expect("estimated");
    for (parameter, name) in free.into_iter().zip(NAMES) {
        let known = report.of_camera(name);
        let (power, factor) = match parameter {
            Parameter::F | Parameter::Cx | Parameter::Cy => (0, pitch),
            Parameter::K1 => (2, -1.0),
            Parameter::K2 => (4, -1.0),
            Parameter::K3 => (6, -1.0),
            Parameter::P2 => (1, -1.0),
            _ => (1, 1.0),
        };
        // A coefficient in millimetres is k/cⁿ, so the standard error of c contributes to its own.
        let scale = factor / c.powi(power);
        let k = value(parameter);
        let own = camera.sigma[&parameter] * scale;
        let with_c = -f64::from(power) * k * scale / c * camera.sigma[&Parameter::F] * pitch;
        let correlation = camera.correlation.matrix[at(parameter)][at(Parameter::F)];
        let sigma =
            if power == 0 { own } else { (own * own + with_c * with_c + 2.0 * correlation * own * with_c).sqrt() };
        agrees(name, k * scale - known.value, sigma, known);
    }
    report.has_photos(&adjustment, &adjustment);
}

#[test]
fn model_3_with_its_affinity_is_reproduced_to_its_printed_digits() {
    let (Some(mut project), Some(report)) = (camcal("camcal-pmexport.txt", &DISTORTED), report("model3")) else {
        return;
    };
    let affinity = 1.0 + report.of_camera("as").value;
    let pitch = HEIGHT_MM / 1704.0;
    project.cameras[0].pixel_pitch = Some([pitch * affinity, pitch]);
    // DBAT scales the residual in x by the affinity, but not its weight.
    for observation in &mut project.observations {
        let [su, sv] = observation.sigma.both();
        observation.sigma = Sigma::Two([su / affinity, sv]);
    }
    let adjustment = solve(&project);
    report.has_sigma0(&adjustment, 1);
    // The report estimates the affinity, so its standard errors are compared with those of an adjustment that estimates B1.
    let mut estimated = project.clone();
    estimated.cameras[0].free.push(Parameter::B1);
    let estimated = solve(&estimated);
    assert_eq!(estimated.redundancy, report.redundancy);
    let camera = &adjustment.cameras[0];
    let half_width = pitch * 2272.0 / 2.0;
    for (parameter, name) in DISTORTED.into_iter().zip(NAMES) {
        let known = report.of_camera(name);
        let value = camera.camera.interior.get(parameter).expect("of the model");
        let value = match parameter {
            Parameter::X0 => half_width + value / affinity,
            Parameter::Y0 => HEIGHT_MM / 2.0 - value,
            _ => value,
        };
        agrees(name, value - known.value, estimated.cameras[0].sigma[&parameter], known);
    }
    report.has_photos(&adjustment, &estimated);
}
