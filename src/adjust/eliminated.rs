//! What the elimination of the points leaves for back-substitution, gradients and cofactors: per point the factor of its
//! normal matrix, per ray Z = GᵀB for its photo, per interior orientation of a point U = CᵀB; see [`super::normal`].

use std::ops::Range;

use super::layout::Layout;
use super::network::Network;
use super::triple::{PointFactor, backward3, forward3};

/// An interior orientation that sees a point.
#[derive(Clone, Copy, Debug)]
pub struct Own {
    /// Index into [`Network::interiors`].
    pub interior: usize,
    /// Number of its unknowns.
    pub length: usize,
    /// Start of its U, three rows of `length` numbers.
    at: usize,
}

/// The eliminated points.
#[derive(Clone, Debug)]
pub struct Eliminated {
    /// Per point; unused for kept ones.
    pub factors: Vec<PointFactor>,
    /// Per ray; unused for rays of kept points.
    pub z: Vec<[[f64; 6]; 3]>,
    /// Points that their rays do not determine, as far as the numbers can tell.
    pub lost: Vec<usize>,
    own: Vec<Own>,
    own_of: Vec<Range<usize>>,
    u: Vec<f64>,
}

impl Eliminated {
    /// Room for a network's points.
    pub fn new(network: &Network) -> Self {
        let (mut own, mut own_of, mut at) = (Vec::<Own>::new(), Vec::new(), 0);
        for point in &network.points {
            let first = own.len();
            for ray in network.rays[point.rays.clone()].iter().filter(|_| !point.kept) {
                let interior = network.photos[ray.photo].interior;
                let length = network.interiors[interior].estimated.len();
                if length > 0 && own[first..].iter().all(|o| o.interior != interior) {
                    own.push(Own { interior, length, at });
                    at += 3 * length;
                }
            }
            own_of.push(first..own.len());
        }
        Self {
            factors: vec![PointFactor::default(); network.points.len()],
            z: vec![[[0.0; 6]; 3]; network.rays.len()],
            lost: Vec::new(),
            own,
            own_of,
            u: vec![0.0; at],
        }
    }

    /// The interior orientations of a point that have unknowns.
    pub fn own(&self, point: usize) -> &[Own] {
        &self.own[self.own_of[point].clone()]
    }

    /// Row `m` of an interior orientation's U.
    #[inline(always)]
    pub fn u(&self, own: &Own, m: usize) -> &[f64] {
        &self.u[own.at + m * own.length..][..own.length]
    }

    /// An interior orientation's U, zeros beyond its unknowns.
    pub fn whole_u<const N: usize>(&self, own: &Own) -> [[f64; N]; 3] {
        let mut u = [[0.0; N]; 3];
        (0..3).for_each(|m| u[m][..own.length].copy_from_slice(self.u(own, m)));
        u
    }

    /// Takes over U of the point's interior orientation number `n`.
    #[inline(always)]
    pub fn set_u<const N: usize>(&mut self, point: usize, n: usize, u: &[[f64; N]; 3]) {
        let own = self.own[self.own_of[point].start + n];
        for (to, from) in self.u[own.at..own.at + 3 * own.length].chunks_exact_mut(own.length).zip(u) {
            to.copy_from_slice(&from[..own.length]);
        }
    }

    /// x -= Z d over the reduced unknowns, d of one point.
    #[inline(always)]
    pub fn subtract(&self, network: &Network, layout: &Layout, point: usize, d: &[f64; 3], x: &mut [f64]) {
        let rays = network.points[point].rays.clone();
        for (ray, z) in network.rays[rays.clone()].iter().zip(&self.z[rays]) {
            let place = layout.photo[ray.photo];
            for (k, x) in x[place..place + 6].iter_mut().enumerate() {
                *x -= z[0][k] * d[0] + z[1][k] * d[1] + z[2][k] * d[2];
            }
        }
        for own in self.own(point) {
            let place = layout.interior[own.interior];
            let (u0, u1, u2) = (self.u(own, 0), self.u(own, 1), self.u(own, 2));
            for (k, x) in x[place..place + own.length].iter_mut().enumerate() {
                *x -= u0[k] * d[0] + u1[k] * d[1] + u2[k] * d[2];
            }
        }
    }

    /// Zᵀx of one point.
    #[inline(always)]
    pub fn product(&self, network: &Network, layout: &Layout, point: usize, x: &[f64]) -> [f64; 3] {
        let rays = network.points[point].rays.clone();
        let mut sum = [0.0; 3];
        for (ray, z) in network.rays[rays.clone()].iter().zip(&self.z[rays]) {
            let x = &x[layout.photo[ray.photo]..][..6];
            for (sum, z) in sum.iter_mut().zip(z) {
                *sum += z.iter().zip(x).map(|(z, x)| z * x).sum::<f64>();
            }
        }
        for own in self.own(point) {
            let x = &x[layout.interior[own.interior]..][..own.length];
            for (m, sum) in sum.iter_mut().enumerate() {
                *sum += self.u(own, m).iter().zip(x).map(|(u, x)| u * x).sum::<f64>();
            }
        }
        sum
    }

    /// Steps of the points from the solution of the reduced equations: δX = -L⁻ᵀ(h + Zᵀδ); 0 on held axes.
    pub fn back_substitute(&self, network: &Network, layout: &Layout, x: &[f64]) -> Vec<[f64; 3]> {
        let step = |point: usize| {
            let block = &network.points[point];
            if block.kept {
                return std::array::from_fn(|a| x[layout.point[point] + a]);
            }
            let PointFactor { l, h, .. } = &self.factors[point];
            let t = self.product(network, layout, point, x);
            let step = backward3(l, std::array::from_fn(|m| -h[m] - t[m]));
            std::array::from_fn(|a| if block.fixed[a] { 0.0 } else { step[a] })
        };
        (0..network.points.len()).map(step).collect()
    }
}

/// A vector over all unknowns.
#[derive(Clone, Debug, PartialEq)]
pub struct Full {
    /// Over the reduced equations, kept points included.
    pub reduced: Vec<f64>,
    /// Over the points; 0 for kept ones.
    pub points: Vec<[f64; 3]>,
}

impl Full {
    /// Zero.
    pub fn zeros(network: &Network, layout: &Layout) -> Self {
        Self { reduced: vec![0.0; layout.size], points: vec![[0.0; 3]; network.points.len()] }
    }

    /// Adds to the number at a point's axis.
    pub fn add_at_point(&mut self, layout: &Layout, point: usize, axis: usize, value: f64) {
        match layout.point[point] {
            usize::MAX => self.points[point][axis] += value,
            place => self.reduced[place + axis] += value,
        }
    }

    /// Number at a point's axis.
    pub fn at_point(&self, layout: &Layout, point: usize, axis: usize) -> f64 {
        if layout.point[point] == usize::MAX {
            self.points[point][axis]
        } else {
            self.reduced[layout.point[point] + axis]
        }
    }

    /// The reduced right-hand side after the points' elimination, and L⁻¹ of the points' own part.
    pub fn forward(&mut self, network: &Network, layout: &Layout, eliminated: &Eliminated) {
        for point in (0..network.points.len()).filter(|p| !network.points[*p].kept) {
            let d = forward3(&eliminated.factors[point].l, self.points[point]);
            self.points[point] = d;
            eliminated.subtract(network, layout, point, &d, &mut self.reduced);
        }
    }

    /// The points' part of a solution, after the reduced part.
    pub fn backward(&mut self, network: &Network, layout: &Layout, eliminated: &Eliminated) {
        for (point, block) in network.points.iter().enumerate().filter(|(_, block)| !block.kept) {
            let sum = eliminated.product(network, layout, point, &self.reduced);
            let d = self.points[point];
            let x = backward3(&eliminated.factors[point].l, std::array::from_fn(|m| d[m] - sum[m]));
            self.points[point] = std::array::from_fn(|a| if block.fixed[a] { 0.0 } else { x[a] });
        }
    }
}
