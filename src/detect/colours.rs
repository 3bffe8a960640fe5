//! Lateral chromatic aberration of the lens, from targets measured in each channel.
//!
//! A lens images red and blue at another scale than green. Every target is measured in all three; of the differences to green
//!
//! du = t_u + (l + c ρ²) x / R and dv = t_v + (l + c ρ²) y / R
//!
//! with x, y from the middle of the picture, R the radius of its corners and ρ = sqrt(x² + y²) / R: a shift, the difference of scale l and that of
//! the cubic distortion c, both in pixels at the corner (Luhmann, Hastedt, Tecklenburg 2006, ISPRS Archives, volume 36, part 5). Weights are the
//! inverse variances of the differences; targets beyond four standard errors are not used.

use nalgebra::{Matrix4, Vector4};

use super::acceptance::colours::{BEYOND, FAR, FEWEST, NEGLIGIBLE_PX, SIGNIFICANT};
use super::{detect_shot, measure_in_shot, sites};
use crate::detection::{Channel, Colour, ColourApart, ColoursApart, DetectOptions, Lateral, Shift, Target};
use crate::error::Result;
use crate::sensor::Shot;

/// Shares of the corner's radius at which the shift is compared with its standard error: both parts may cancel at one of them.
const RADII: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Measures the targets of a photo in green, red and blue. `shot` gives the photo for a channel; that of a sensor is asked for once.
///
/// # Errors
/// As for [`detect_shot`], and those of `shot`.
pub fn colours_apart(shot: impl Fn(Channel) -> Result<Shot>, options: &DetectOptions) -> Result<ColoursApart> {
    let options = DetectOptions { channel: Channel::Green, ..options.clone() };
    let green = shot(Channel::Green)?;
    let targets = detect_shot(&green, &options)?.targets;
    let [left, top, width, height] = match &green {
        Shot::Sensor(sensor) => sensor.mosaic.active_area.map(f64::from),
        Shot::Photo(_) => [0.0, 0.0, green.size()[0] as f64, green.size()[1] as f64],
    };
    let (centre, corner) = ([left + width / 2.0, top + height / 2.0], width.hypot(height) / 2.0);
    let mut apart = ColoursApart { centre, corner, colours: Vec::new() };
    for (channel, colour) in [(Channel::Red, Colour::Red), (Channel::Blue, Colour::Blue)] {
        let options = DetectOptions { channel, ..options.clone() };
        let others = match &green {
            Shot::Sensor(sensor)
                if !(sensor.mosaic.pattern.has(colour) && sensor.mosaic.pattern.has(Colour::Green)) =>
            {
                continue;
            }
            Shot::Sensor(sensor) => sites::measured_again(sensor, &targets, &options)?,
            Shot::Photo(_) => {
                let other = shot(channel)?;
                let again = |target: &Target| measure_in_shot(&other, target.u, target.v, &options);
                targets.iter().map(again).collect::<Result<Vec<_>>>()?
            }
        };
        let pairs = targets.iter().zip(others).filter_map(|(green, other)| Some(shift(green, &other?)));
        let shifts: Vec<Shift> = pairs.filter(|shift| shift.du.hypot(shift.dv) < BEYOND).collect();
        let lateral = lateral(&shifts, centre, corner);
        apart.colours.push(ColourApart { colour, shifts, lateral });
    }
    Ok(apart)
}

fn shift(green: &Target, other: &Target) -> Shift {
    Shift {
        u: green.u,
        v: green.v,
        du: other.u - green.u,
        dv: other.v - green.v,
        sigma_u: green.sigma_u.hypot(other.sigma_u),
        sigma_v: green.sigma_v.hypot(other.sigma_v),
    }
}

/// The four unknowns from the differences; none from too few, or where all have one radius.
fn lateral(shifts: &[Shift], [cu, cv]: [f64; 2], corner: f64) -> Option<Lateral> {
    let rows = |shift: &Shift| {
        let [x, y] = [(shift.u - cu) / corner, (shift.v - cv) / corner];
        let square = x * x + y * y;
        let across = (Vector4::new(1.0, 0.0, x, x * square), shift.du, shift.sigma_u);
        let down = (Vector4::new(0.0, 1.0, y, y * square), shift.dv, shift.sigma_v);
        [across, down]
    };
    let is_sound = |shift: &&Shift| shift.sigma_u > 0.0 && shift.sigma_v > 0.0;
    let mut kept: Vec<&Shift> = shifts.iter().filter(is_sound).collect();
    for _ in 0..6 {
        if kept.len() < FEWEST {
            return None;
        }
        let (mut normal, mut right) = (Matrix4::zeros(), Vector4::zeros());
        for (row, value, sigma) in kept.iter().flat_map(|shift| rows(shift)) {
            let weight = 1.0 / (sigma * sigma);
            normal += weight * row * row.transpose();
            right += weight * value * row;
        }
        let scale = normal.diagonal().map(|d| 1.0 / d.max(1e-300).sqrt());
        let scaled = Matrix4::from_diagonal(&scale) * normal * Matrix4::from_diagonal(&scale);
        if scaled.symmetric_eigenvalues().min() < 1e-9 {
            return None;
        }
        let inverse = Matrix4::from_diagonal(&scale) * scaled.cholesky()?.inverse() * Matrix4::from_diagonal(&scale);
        let unknowns = inverse * right;
        let residuals = |shift: &Shift| rows(shift).map(|(row, value, sigma)| (value - row.dot(&unknowns), sigma));
        let (mut squares, mut weighted) = (0.0, 0.0);
        for (residual, sigma) in kept.iter().flat_map(|shift| residuals(shift)) {
            squares += residual * residual;
            weighted += (residual / sigma).powi(2);
        }
        let free = (2 * kept.len() - 4) as f64;
        let sigma0 = (weighted / free).sqrt();
        let count = kept.len();
        let limit = FAR * sigma0.max(1.0);
        kept.retain(|shift| residuals(shift).iter().all(|(residual, sigma)| residual.abs() <= limit * sigma));
        if kept.len() < count {
            continue;
        }
        let sum = Vector4::new(0.0, 0.0, 1.0, 1.0);
        let mut lateral = Lateral {
            shift_u: unknowns[0],
            shift_v: unknowns[1],
            linear: unknowns[2],
            cubic: unknowns[3],
            at_corner: unknowns[2] + unknowns[3],
            sigma_at_corner: sigma0.max(1.0) * sum.dot(&(inverse * sum)).max(0.0).sqrt(),
            rms: (squares / (2 * count) as f64).sqrt(),
            sigma0,
            targets: count,
            significant: false,
            covariance: upper(&(inverse * sigma0.max(1.0).powi(2))),
        };
        lateral.significant = RADII
            .iter()
            .map(|share| lateral.at(*share))
            .any(|[shift, sigma]| shift.abs() > SIGNIFICANT * sigma && shift.abs() > NEGLIGIBLE_PX);
        return Some(lateral);
    }
    None
}

fn upper(matrix: &Matrix4<f64>) -> [f64; 10] {
    let mut places = (0..4).flat_map(|i| (i..4).map(move |j| (i, j)));
    std::array::from_fn(|_| places.next().map_or(0.0, |place| matrix[place]))
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::noise::Noise;

    fn shifts(noise: f64) -> Vec<Shift> {
        let mut random = Noise::new(4, 0);
        let mut shifts = Vec::new();
        for k in 0..120 {
            let [u, v] = [40.0 + 90.0 * f64::from(k % 12), 30.0 + 75.0 * f64::from(k / 12)];
            let [x, y] = [(u - 540.0) / 680.0, (v - 360.0) / 680.0];
            let grown = 0.7 - 0.3 * (x * x + y * y);
            let [du, dv] = [0.05 + grown * x, -0.02 + grown * y].map(|d| d + noise * random.normal());
            shifts.push(Shift { u, v, du, dv, sigma_u: noise.max(1e-3), sigma_v: noise.max(1e-3) });
        }
        shifts
    }

    #[test]
    fn a_known_aberration_comes_back() {
        let exact = lateral(&shifts(0.0), [540.0, 360.0], 680.0).expect("a lens");
        let of = |lateral: &Lateral| [lateral.shift_u, lateral.shift_v, lateral.linear, lateral.cubic];
        assert!(of(&exact).iter().zip([0.05, -0.02, 0.7, -0.3]).all(|(a, b)| (a - b).abs() < 1e-9), "{exact:?}");
        let mut noisy = shifts(0.01);
        noisy[7].du += 1.0;
        let found = lateral(&noisy, [540.0, 360.0], 680.0).expect("a lens");
        assert_eq!(found.targets, 119);
        assert!((found.at_corner - 0.4).abs() < 4.0 * found.sigma_at_corner, "{found:?}");
        assert!((0.85..1.15).contains(&found.sigma0), "{found:?}");
        let [corner, sigma] = found.at(1.0);
        assert!((corner - found.at_corner).abs() < 1e-12 && (sigma / found.sigma_at_corner - 1.0).abs() < 1e-9);
        let [half, sigma] = found.at(0.5);
        assert!((half - (0.35 - 0.0375)).abs() < 4.0 * sigma && sigma > 0.0, "{half} {sigma}");
        assert_eq!(found.at(0.0), [0.0, 0.0]);
        assert!(found.significant && exact.significant);
    }

    /// A shift is significant where both parts cancel at the corner, and is not where there is none or only noise.
    #[test]
    fn only_what_exceeds_its_standard_errors_is_significant() {
        let with = |linear: f64, cubic: f64, noise: f64| {
            let mut all = shifts(noise);
            for shift in &mut all {
                let [x, y] = [(shift.u - 540.0) / 680.0, (shift.v - 360.0) / 680.0];
                let grown = linear - 0.7 + (cubic + 0.3) * (x * x + y * y);
                (shift.du, shift.dv) = (shift.du + grown * x, shift.dv + grown * y);
            }
            lateral(&all, [540.0, 360.0], 680.0).expect("a lens").significant
        };
        assert!(with(0.5, -0.5, 0.01));
        assert!(!with(0.0, 0.0, 0.02) && !with(0.5, -0.5, 2.0));
        assert!(!with(0.01, 0.0, 0.001));
    }

    /// Estimates scatter according to their covariance: the mean of xᵀ Q⁻¹ x over many of them is its four degrees of freedom.
    #[test]
    fn the_covariance_is_the_scatter() {
        let clean = shifts(0.0);
        let (mut random, mut sum) = (Noise::new(9, 0), 0.0);
        const RUNS: usize = 400;
        for _ in 0..RUNS {
            let mut noisy = clean.clone();
            for shift in &mut noisy {
                (shift.sigma_u, shift.sigma_v) = (0.01, 0.02);
                shift.du += 0.01 * random.normal();
                shift.dv += 0.02 * random.normal();
            }
            let found = lateral(&noisy, [540.0, 360.0], 680.0).expect("a lens");
            let off = Vector4::new(found.shift_u - 0.05, found.shift_v + 0.02, found.linear - 0.7, found.cubic + 0.3);
            let [a, b, c, d, e, f, g, h, i, j] = found.covariance;
            let covariance = Matrix4::new(a, b, c, d, b, e, f, g, c, f, h, i, d, g, i, j);
            sum += off.dot(&(covariance.try_inverse().expect("regular") * off));
        }
        let mean = sum / RUNS as f64;
        // 1600 degrees of freedom scatter by 0.14; sigma0 is taken as at least 1
        assert!((3.3..4.45).contains(&mean), "{mean}");
    }

    #[test]
    fn too_little_says_nothing() {
        assert_eq!(lateral(&shifts(0.01)[..5], [540.0, 360.0], 680.0), None);
        let same = vec![shifts(0.01)[0]; 20];
        assert_eq!(lateral(&same, [540.0, 360.0], 680.0), None);
    }
}
