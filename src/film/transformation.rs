//! Plane transformations onto fiducial marks, with residuals and standard errors.
//!
//! ```text
//! similarity   x' = a0 + a1 x - b1 y              y' = b0 + b1 x + a1 y                       4 parameters
//! affine       x' = a0 + a1 x + a2 y              y' = b0 + b1 x + b2 y                       6
//! projective   x' = (a0 + a1 x + a2 y) / (1 + c1 x + c2 y)   y' = (b0 + b1 x + b2 y) / (…)    8
//! ```
//!
//! The squared differences in the target system are minimised. Coordinates are reduced to the centroid and scaled, so that the origin of
//! the comparator has no effect. Source: Kang and Yeu (1985), figure 3-3 (affine); Wolf (1983).

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use crate::error::{Error, Place, Reason, Result};

/// Kind of plane transformation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// Shift, rotation and one scale.
    Similarity,
    /// Shift, rotation, two scales and a shear: film shrinks differently along and across.
    #[default]
    Affine,
    /// Perspective.
    Projective,
}

impl Kind {
    /// Number of parameters.
    pub fn parameters(self) -> usize {
        match self {
            Self::Similarity => 4,
            Self::Affine => 6,
            Self::Projective => 8,
        }
    }
}

/// A fitted transformation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Transformation {
    /// Its kind.
    pub kind: Kind,
    /// Transformed minus given, per mark, in target units.
    pub residuals: Vec<[f64; 2]>,
    /// 2n - parameters.
    pub redundancy: usize,
    /// Standard error of a coordinate, √(Σv²/redundancy); `None` without redundancy.
    pub sigma0: Option<f64>,
    /// Rows of the 3 x 3 matrix that transforms homogeneous comparator coordinates into target coordinates.
    pub matrix: [[f64; 3]; 3],
    /// Parameters for comparator coordinates, by name.
    pub parameters: Vec<Coefficient>,
    /// Comparator coordinates of the centroid to which the parameters refer.
    pub origin: [f64; 2],
}

/// A parameter with its standard error.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coefficient {
    /// Name in the equations of the module.
    pub name: String,
    /// Value, for comparator coordinates relative to the centroid of the marks.
    pub value: f64,
    /// Standard error; `None` without redundancy.
    pub sigma: Option<f64>,
}

impl Transformation {
    /// A measured point in the target system; `None` on the vanishing line of a projective transformation.
    pub fn apply(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let row = |r: [f64; 3]| r[0] * x + r[1] * y + r[2];
        let [p, q, w] = self.matrix.map(row);
        let image = [p / w, q / w];
        image.iter().all(|n| n.is_finite()).then_some(image)
    }
}

/// The least-squares transformation from `measured` to `given` (paired).
///
/// # Errors
/// [`Error::Invalid`] if the lists differ in length, contain numbers that are not finite, are too short for the kind, or if the marks
/// lie on a line (for the projective kind: all marks except one).
pub fn fit(kind: Kind, measured: &[[f64; 2]], given: &[[f64; 2]]) -> Result<Transformation> {
    let n = measured.len();
    let needed = kind.parameters() / 2;
    if n != given.len() || n < needed || measured.iter().chain(given).flatten().any(|c| !c.is_finite()) {
        return invalid(Reason::TooFewMarks { measured: n, given: given.len(), needed });
    }
    let origin = centroid(measured);
    let scale = spread(measured, origin);
    let target = centroid(given);
    let size = spread(given, target);
    if scale == 0.0 || size == 0.0 {
        return invalid(Reason::MarksInOnePoint);
    }
    let from: Vec<_> = measured.iter().map(|p| [0, 1].map(|k| (p[k] - origin[k]) / scale)).collect();
    let to: Vec<_> = given.iter().map(|p| [0, 1].map(|k| (p[k] - target[k]) / size)).collect();

    // Gauss-Newton; one step for the linear kinds. The projective one starts from its affine part, since without it
    // its last two parameters have no effect.
    let mut h = [0.0; 8];
    if kind == Kind::Projective {
        let [p, q, _] = fit(Kind::Affine, &from, &to)?.matrix;
        h = [p[2], p[0], p[1], q[2], q[0], q[1], 0.0, 0.0];
    }
    let mut inverse = DMatrix::zeros(0, 0);
    for _ in 0..if kind == Kind::Projective { 20 } else { 1 } {
        let (a, l) = equations(kind, &from, &to, &h);
        let Some(normal) = (a.transpose() * &a).try_inverse().filter(|q| q.max().is_finite() && q.max() < 1e12) else {
            return invalid(Reason::MarksOnALine);
        };
        let step = &normal * (a.transpose() * l);
        step.iter().enumerate().for_each(|(k, s)| h[k] += s);
        inverse = normal;
        if step.norm() < 1e-14 {
            break;
        }
    }
    let unscaled = homogeneous(kind, &h);
    let residual = |(p, q): (&[f64; 2], &[f64; 2])| {
        let image = project(&unscaled, *p);
        [0, 1].map(|k| (image[k] - q[k]) * size)
    };
    let residuals: Vec<_> = from.iter().zip(&to).map(residual).collect();
    let squares: f64 = residuals.iter().flatten().map(|v| v * v).sum();
    let redundancy = 2 * n - kind.parameters();
    let sigma0 = (redundancy > 0).then(|| (squares / redundancy as f64).sqrt());
    let value = coefficients(kind, &h, &inverse, sigma0, [scale, size, target[0], target[1]]);
    Ok(Transformation {
        kind,
        residuals,
        redundancy,
        sigma0,
        matrix: unnormalised(&unscaled, origin, scale, target, size),
        parameters: value,
        origin,
    })
}

fn invalid<T>(reason: Reason) -> Result<T> {
    Err(Error::Invalid { reason, at: Place::field("fiducials") })
}

fn centroid(points: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / points.len() as f64)
}

/// Root mean square distance from the centroid.
fn spread(points: &[[f64; 2]], c: [f64; 2]) -> f64 {
    let square: f64 = points.iter().map(|p| (p[0] - c[0]).powi(2) + (p[1] - c[1]).powi(2)).sum();
    (square / points.len() as f64).sqrt()
}

/// Design matrix and misclosures (given minus transformed), rows x and y of each mark.
fn equations(kind: Kind, from: &[[f64; 2]], to: &[[f64; 2]], h: &[f64; 8]) -> (DMatrix<f64>, DVector<f64>) {
    let mut a = DMatrix::zeros(2 * from.len(), kind.parameters());
    let mut l = DVector::zeros(2 * from.len());
    let matrix = homogeneous(kind, h);
    for (i, (&[x, y], given)) in from.iter().zip(to).enumerate() {
        let image = project(&matrix, [x, y]);
        let w = matrix[2][0] * x + matrix[2][1] * y + 1.0;
        let rows: [&[f64]; 2] = match kind {
            Kind::Similarity => [&[1.0, 0.0, x, -y], &[0.0, 1.0, y, x]],
            Kind::Affine => [&[1.0, x, y, 0.0, 0.0, 0.0], &[0.0, 0.0, 0.0, 1.0, x, y]],
            Kind::Projective => [
                &[1.0, x, y, 0.0, 0.0, 0.0, -x * image[0], -y * image[0]],
                &[0.0, 0.0, 0.0, 1.0, x, y, -x * image[1], -y * image[1]],
            ],
        };
        for k in 0..2 {
            rows[k].iter().enumerate().for_each(|(column, value)| a[(2 * i + k, column)] = value / w);
            l[2 * i + k] = given[k] - image[k];
        }
    }
    (a, l)
}

/// The parameters as a 3 x 3 matrix.
fn homogeneous(kind: Kind, h: &[f64; 8]) -> [[f64; 3]; 3] {
    match kind {
        Kind::Similarity => [[h[2], -h[3], h[0]], [h[3], h[2], h[1]], [0.0, 0.0, 1.0]],
        Kind::Affine | Kind::Projective => [[h[1], h[2], h[0]], [h[4], h[5], h[3]], [h[6], h[7], 1.0]],
    }
}

fn project(m: &[[f64; 3]; 3], [x, y]: [f64; 2]) -> [f64; 2] {
    let [p, q, w] = m.map(|r| r[0] * x + r[1] * y + r[2]);
    [p / w, q / w]
}

/// The matrix for comparator and target coordinates that are not reduced and scaled.
fn unnormalised(m: &[[f64; 3]; 3], origin: [f64; 2], scale: f64, target: [f64; 2], size: f64) -> [[f64; 3]; 3] {
    // Columns: x and y over scale, less the origin.
    let columns = m.map(|[x, y, one]| [x / scale, y / scale, one - (x * origin[0] + y * origin[1]) / scale]);
    let shifted = |row: [f64; 3], shift: f64| [0, 1, 2].map(|k| size * row[k] + shift * columns[2][k]);
    let matrix = [shifted(columns[0], target[0]), shifted(columns[1], target[1]), columns[2]];
    let last = matrix[2][2];
    if last == 0.0 { matrix } else { matrix.map(|row| row.map(|value| value / last)) }
}

/// Parameters for comparator coordinates relative to their centroid, with standard errors.
fn coefficients(
    kind: Kind,
    h: &[f64; 8],
    inverse: &DMatrix<f64>,
    sigma0: Option<f64>,
    [scale, size, shift_x, shift_y]: [f64; 4],
) -> Vec<Coefficient> {
    let per_length = size / scale;
    // Name, factor, shift of each parameter in the order of the equations.
    let list: &[(&str, f64, f64)] = match kind {
        Kind::Similarity => {
            &[("a0", size, shift_x), ("b0", size, shift_y), ("a1", per_length, 0.0), ("b1", per_length, 0.0)]
        }
        Kind::Affine | Kind::Projective => &[
            ("a0", size, shift_x),
            ("a1", per_length, 0.0),
            ("a2", per_length, 0.0),
            ("b0", size, shift_y),
            ("b1", per_length, 0.0),
            ("b2", per_length, 0.0),
            ("c1", 1.0 / scale, 0.0),
            ("c2", 1.0 / scale, 0.0),
        ],
    };
    let coefficient = |(k, (name, factor, shift)): (usize, &(&str, f64, f64))| Coefficient {
        name: (*name).to_owned(),
        value: h[k] * factor + shift,
        sigma: sigma0.map(|s| s / size * inverse[(k, k)].max(0.0).sqrt() * factor.abs()),
    };
    list.iter().take(kind.parameters()).enumerate().map(coefficient).collect()
}

#[cfg(test)]
mod tests {
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    use super::*;
    use crate::noise::Noise;

    const MARKS: [[f64; 2]; 6] =
        [[-40.0, -55.0], [41.0, -54.0], [39.5, 56.0], [-40.5, 55.0], [0.2, 56.5], [-0.4, -55.5]];

    /// Marks as a comparator with another origin, rotation and unit would measure them.
    fn measured(h: [[f64; 3]; 3]) -> Vec<[f64; 2]> {
        MARKS.iter().map(|p| project(&h, *p)).collect()
    }

    #[test]
    fn each_kind_recovers_transformations_of_its_kind() {
        let turned = [[0.98, -0.2, 312.4], [0.2, 0.98, 107.9], [0.0, 0.0, 1.0]];
        let sheared = [[0.98, -0.21, 312.4], [0.2, 0.97, 107.9], [0.0, 0.0, 1.0]];
        let tilted = [[0.98, -0.21, 312.4], [0.2, 0.97, 107.9], [1e-4, -2e-4, 1.0]];
        for (kind, h) in [(Kind::Similarity, turned), (Kind::Affine, sheared), (Kind::Projective, tilted)] {
            let machine = measured(h);
            let fitted = fit(kind, &machine, &MARKS).unwrap();
            assert!(fitted.residuals.iter().flatten().all(|v| v.abs() < 1e-10), "{kind:?} {:?}", fitted.residuals);
            let other = [17.3, -22.2];
            let back = fitted.apply(project(&h, other)).unwrap();
            assert!((back[0] - other[0]).abs() < 1e-9 && (back[1] - other[1]).abs() < 1e-9, "{kind:?} {back:?}");
        }
        // A similarity cannot express shear: it shows in the residuals.
        assert!(fit(Kind::Similarity, &measured(sheared), &MARKS).unwrap().sigma0.unwrap() > 0.1);
    }

    #[test]
    fn standard_errors_predict_the_scatter() {
        for kind in [Kind::Similarity, Kind::Affine, Kind::Projective] {
            let mut noise = Noise::new(5, 0);
            let (rounds, sigma) = (2000, 0.003);
            let (mut variance, mut predicted, mut s0) = (vec![0.0; 8], vec![0.0; 8], 0.0);
            let truth = fit(kind, &MARKS, &MARKS).unwrap();
            for _ in 0..rounds {
                let given: Vec<_> = MARKS.iter().map(|p| p.map(|c| c + sigma * noise.normal())).collect();
                let fitted = fit(kind, &MARKS, &given).unwrap();
                s0 += fitted.sigma0.unwrap().powi(2) / rounds as f64;
                for (k, (f, t)) in fitted.parameters.iter().zip(&truth.parameters).enumerate() {
                    variance[k] += (f.value - t.value).powi(2) / rounds as f64;
                    predicted[k] += f.sigma.unwrap().powi(2) / rounds as f64;
                }
            }
            assert!((s0.sqrt() / sigma - 1.0).abs() < 0.03);
            for k in 0..kind.parameters() {
                assert!(
                    (variance[k] / predicted[k] - 1.0).abs() < 0.15,
                    "{kind:?} {k}: {} {}",
                    variance[k],
                    predicted[k]
                );
            }
        }
    }

    #[test]
    fn marks_on_a_line_and_lists_that_do_not_match_are_refused() {
        let line: Vec<_> = (0..5).map(|k| [f64::from(k), 2.0 * f64::from(k)]).collect();
        assert_eq!(fit(Kind::Affine, &line, &line).expect_err("a line").code(), "invalid");
        assert!(fit(Kind::Similarity, &line, &line).is_ok());
        assert!(fit(Kind::Affine, &MARKS[..2], &MARKS[..2]).is_err());
        assert!(fit(Kind::Affine, &MARKS, &MARKS[..5]).is_err());
        assert!(fit(Kind::Affine, &[[f64::NAN, 0.0]; 4], &MARKS[..4]).is_err());
    }

    #[test]
    fn four_marks_leave_an_affine_fit_two_redundant() {
        let fitted = fit(Kind::Affine, &MARKS[..4], &MARKS[..4]).unwrap();
        assert_eq!(fitted.redundancy, 2);
        let fitted = fit(Kind::Projective, &MARKS[..4], &MARKS[..4]).unwrap();
        assert_eq!((fitted.redundancy, fitted.sigma0), (0, None));
    }
}
