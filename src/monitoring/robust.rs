//! The robust datum: that in which the sum of the lengths of the displacements of the reference points is smallest.
//!
//! Iteratively reweighted S-transformation with the weights 1 / (|d_i| + ε) (Y. Q. Chen, Analysis of deformation surveys, 1983;
//! E. J. Schlossmacher 1973).

use nalgebra::Vector3;

use super::covariance::ReferenceDatum;

/// Rounds at most: each lowers the sum, and after some twenty the weights have separated.
const ROUNDS: usize = 60;
/// ε as a part of the typical standard error: below it lengths are one and the same.
const SMALLEST: f64 = 0.05;

/// The datum of smallest displacements and the differences in it. `None` if the points lie on a line.
pub fn robust_datum(
    points: &[Vector3<f64>],
    d: &[Vector3<f64>],
    reference: &[usize],
    sigma: f64,
    defect: usize,
) -> Option<(ReferenceDatum, Vec<Vector3<f64>>)> {
    let least = SMALLEST * sigma;
    let mut weights: Vec<(usize, f64)> = reference.iter().map(|&k| (k, 1.0)).collect();
    let mut datum = ReferenceDatum::new(points, &weights, defect)?;
    let mut current = datum.difference(d);
    for _ in 0..ROUNDS {
        for (k, weight) in &mut weights {
            *weight = 1.0 / (current[*k].norm() + least);
        }
        let Some(next) = ReferenceDatum::new(points, &weights, defect) else { break };
        let moved = next.difference(d);
        let change = reference.iter().map(|&k| (moved[k] - current[k]).norm()).fold(0.0, f64::max);
        (datum, current) = (next, moved);
        if change < 1e-3 * least {
            break;
        }
    }
    Some((datum, current))
}
