//! The S-transformation that brings cofactors into their datum: Q' = Q - G V - VᵀGᵀ + G (…) Gᵀ with V = (DᵀG)⁻¹DᵀQ.

use nalgebra::{DMatrix, SMatrix};

use crate::adjust::equations::context::Context;
use crate::adjust::equations::normal::ReducedNormalEquations;
use crate::adjust::linear::cholesky3::forward3;

use super::free::{FreeDatum, SIMILARITY};

/// The datum's S-transformation at reduced unknowns: V = (DᵀG)⁻¹DᵀQ, and (DᵀG)⁻¹DᵀQD(DᵀG)⁻ᵀ.
pub struct STransformation {
    /// Number of datum directions.
    pub defect: usize,
    /// One vector over the reduced unknowns per direction.
    pub v: Vec<Vec<f64>>,
    /// D per carrier, times the inverse: one row a carrier.
    pub d: DMatrix<f64>,
    /// (DᵀG)⁻¹DᵀQD(DᵀG)⁻ᵀ.
    pub square: SMatrix<f64, SIMILARITY, SIMILARITY>,
}

/// (DᵀG)⁻¹ᵀ-weighted constraint of the datum at one point: per direction a vector over its axes.
pub fn carried(t: &STransformation, datum: Option<&FreeDatum>, point: usize) -> Vec<[f64; 3]> {
    let mut own = vec![[0.0; 3]; t.defect];
    let carriers = datum.map_or(&[][..], |d| &d.carriers[..]);
    let first = carriers.partition_point(|(p, _)| *p < point);
    for (k, (_, axis)) in carriers.iter().enumerate().skip(first).take_while(|(_, (p, _))| *p == point) {
        for (j, own) in own.iter_mut().enumerate() {
            own[*axis] += t.d[(k, j)];
        }
    }
    own
}

/// Q' = Q - G V - VᵀGᵀ + G (…) Gᵀ for one block.
pub fn transformed<const K: usize>(
    q: &SMatrix<f64, K, K>,
    g: &SMatrix<f64, K, SIMILARITY>,
    v: &SMatrix<f64, SIMILARITY, K>,
    t: &STransformation,
) -> SMatrix<f64, K, K> {
    let gv = g * v;
    q - gv - gv.transpose() + g * t.square * g.transpose()
}

/// Solves the equations for the datum's constraints as right-hand sides.
pub fn transformation(
    normal: &ReducedNormalEquations,
    context: Context<'_>,
    datum: &FreeDatum,
) -> Option<STransformation> {
    let Context { network, layout, state, .. } = context;
    // D (DᵀG)⁻ᵀ, so that everything below is already multiplied by the inverse.
    let d = datum.constraint_rows(state) * datum.inverse_of_constrained(state)?.transpose();
    let mut t = STransformation {
        defect: datum.defect,
        v: vec![vec![0.0; layout.size]; datum.defect],
        d,
        square: SMatrix::zeros(),
    };
    let mut eliminated = Vec::new();
    let mut carriers: Vec<usize> = datum.carriers.iter().map(|(point, _)| *point).collect();
    carriers.dedup();
    for &point in &carriers {
        let own = carried(&t, Some(datum), point);
        if network.points[point].kept {
            let at = layout.point[point];
            own.iter().zip(&mut t.v).for_each(|(own, v)| (0..3).for_each(|a| v[at + a] += own[a]));
            continue;
        }
        let l = &normal.eliminated.factors[point].l;
        for (own, v) in own.iter().zip(&mut t.v) {
            normal.eliminated.subtract(network, layout, point, &forward3(l, *own), v);
        }
        eliminated.push((point, own));
    }
    let right_hand_sides = t.v.clone();
    t.v.iter_mut().for_each(|v| normal.matrix.solve(v));
    // Square: Σ over carriers of own·x at the carrier = rᵀQr of the reduced part + what the eliminated points add.
    for i in 0..t.defect {
        for j in 0..t.defect {
            let mut sum: f64 = right_hand_sides[i].iter().zip(&t.v[j]).map(|(r, x)| r * x).sum();
            for (point, own) in &eliminated {
                let l = &normal.eliminated.factors[*point].l;
                let (a, b) = (forward3(l, own[i]), forward3(l, own[j]));
                sum += a.iter().zip(&b).map(|(a, b)| a * b).sum::<f64>();
            }
            t.square[(i, j)] = sum;
        }
    }
    Some(t)
}
