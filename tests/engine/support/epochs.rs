//! Epochs of points whose truth is known: full random covariances, systems of their own, a variance factor that is estimated.

use nalgebra::{DMatrix, DVector, Rotation3, Vector3};
use sightline::monitoring::{Epoch, ListedCovariance, ListedPoint};
use sightline::noise::Noise;
use statrs::distribution::{Binomial, DiscreteCDF};

/// Standard error of a coordinate, mm.
pub const SIGMA: f64 = 0.05;

/// An object of reference points `r0`... and object points `o0`..., mm.
pub fn object(seed: u64, references: usize, objects: usize) -> Vec<(String, Vector3<f64>)> {
    let mut random = super::networks::Uniform(seed);
    let mut place =
        || Vector3::new(random.between(-5e3, 5e3), random.between(-4e3, 4e3), random.between(-1.5e3, 1.5e3));
    let references = (0..references).map(|k| format!("r{k}"));
    references.chain((0..objects).map(|k| format!("o{k}"))).map(|id| (id, place())).collect()
}

/// Data of an epoch.
#[derive(Clone, Debug)]
pub struct Made {
    /// Seed of noise and covariance.
    pub seed: u64,
    /// Degrees of freedom of the variance factor.
    pub redundancy: usize,
    /// Whether the epoch is in a system of its own.
    pub turned: bool,
    /// Factor on the standard errors of the covariance that is stated; 1: they are right.
    pub overstated: f64,
}

impl Made {
    pub fn new(seed: u64) -> Self {
        Self { seed, redundancy: 60, turned: true, overstated: 1.0 }
    }
}

/// A covariance of correlated coordinates and a draw from it.
pub fn drawn(n: usize, noise: &mut Noise) -> (DMatrix<f64>, DVector<f64>) {
    let mut a = DMatrix::from_fn(3 * n, 3 * n, |_, _| 0.5 * noise.normal() / (3.0 * n as f64).sqrt());
    (0..3 * n).for_each(|k| a[(k, k)] += 1.0);
    a *= SIGMA;
    let draw = DVector::from_fn(3 * n, |_, _| noise.normal());
    (&a * a.transpose(), a * draw)
}

/// An epoch of the object with these displacements.
pub fn epoch(name: &str, object: &[(String, Vector3<f64>)], moved: &[(usize, Vector3<f64>)], made: &Made) -> Epoch {
    let n = object.len();
    let mut noise = Noise::new(made.seed, 3);
    let (mut covariance, errors) = drawn(n, &mut noise);
    let mut xyz: Vec<Vector3<f64>> =
        object.iter().enumerate().map(|(k, (_, x))| x + errors.fixed_rows::<3>(3 * k)).collect();
    moved.iter().for_each(|(k, d)| xyz[*k] += d);
    let squares: f64 = (0..made.redundancy).map(|_| noise.normal().powi(2)).sum();
    let sigma0 = (squares / made.redundancy as f64).sqrt() * made.overstated;
    covariance *= sigma0 * sigma0;
    if made.turned {
        let turn = Rotation3::new(Vector3::from_fn(|_, _| noise.normal()));
        let shift = Vector3::from_fn(|_, _| 1e4 * noise.normal());
        xyz.iter_mut().for_each(|x| *x = turn * *x + shift);
        let wide = DMatrix::from_fn(3 * n, 3 * n, |i, j| if i / 3 == j / 3 { turn[(i % 3, j % 3)] } else { 0.0 });
        covariance = &wide * covariance * wide.transpose();
    }
    let points =
        object.iter().zip(&xyz).map(|((id, _), x)| ListedPoint { id: id.clone(), xyz: (*x).into(), sigma: None });
    Epoch {
        name: name.into(),
        points: Some(points.collect()),
        covariance: Some(ListedCovariance {
            points: object.iter().map(|(id, _)| id.clone()).collect(),
            matrix: covariance.row_iter().map(|row| row.iter().copied().collect()).collect(),
        }),
        sigma0: Some(sigma0),
        redundancy: Some(made.redundancy as f64),
        unit: Some("mm".into()),
        ..Epoch::default()
    }
}

/// A unit vector of any direction.
pub fn direction(noise: &mut Noise) -> Vector3<f64> {
    Vector3::from_fn(|_, _| noise.normal()).normalize()
}

/// Names of the first reference points.
pub fn references(count: usize) -> Vec<String> {
    (0..count).map(|k| format!("r{k}")).collect()
}

/// The exact interval that holds a binomial number with a probability of 99 %.
pub fn band(trials: usize, probability: f64) -> std::ops::RangeInclusive<usize> {
    let binomial = Binomial::new(probability, trials as u64).expect("a probability");
    let number = |share: f64| (0..=trials).find(|k| binomial.cdf(*k as u64) >= share).unwrap_or(trials);
    number(0.005)..=number(0.995)
}
