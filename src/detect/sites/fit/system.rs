//! The normal equations of the fit: the value of the model at a site and its derivatives.

use nalgebra::{SMatrix, SVector};

use super::{Site, SiteFitState, Sites};
use crate::detect::acceptance::sites::WHITE;
use crate::detect::ellipse::outline::Outline;
use crate::detect::rendered::Field;

/// u, v, p, q, r, s, contrast, the background's level, and the slopes of the light.
pub(super) const UNKNOWNS: usize = 10;
type SiteNormalMatrix = SMatrix<f64, UNKNOWNS, UNKNOWNS>;
pub(super) type SiteUnknowns = SVector<f64, UNKNOWNS>;

/// Value of the model at a site.
pub(super) struct Modelled {
    pub level: f64,
    share: f64,
    /// In units of that at the place that the slopes are counted from.
    lit: f64,
    /// After u, v and s.
    slopes: [f64; 3],
}

pub(super) fn modelled(site: &Site, state: &SiteFitState, field: &Field, origin: [f64; 2]) -> Modelled {
    let (column, row) = (site.x - field.left, site.y - field.top);
    let [x, y] = [site.x as f64 + 0.5 - origin[0], site.y as f64 + 0.5 - origin[1]];
    let inside = (0..field.width as i64).contains(&column) && (0..field.height as i64).contains(&row);
    let (share, slopes) = if inside {
        let (column, row) = (column as usize, row as usize);
        let slope = |which: usize| f64::from(field.derivative(which, row)[column]);
        (f64::from(field.share(row)[column]), [slope(0), slope(1), slope(2)])
    } else {
        (0.0, [0.0; 3])
    };
    let lit = state.lit.at(x, y);
    Modelled { level: state.lit.tone(share) * lit, share, lit, slopes }
}

/// Whether the white level leaves a site alone: by its sample at first, then by what the model expects of it.
pub(super) fn counts(sites: &Sites, site: &Site, level: f64, by_sample: bool) -> bool {
    let white = sites.clip - site.black;
    site.kept && if by_sample { !site.clipped } else { level < white - WHITE * sites.noise.deviation(white) }
}

/// How the model of a site changes with the unknowns.
fn row(site: &Site, state: &SiteFitState, model: &Modelled, origin: [f64; 2]) -> [f64; UNKNOWNS] {
    let Outline { u, v, p, q, r } = state.outline;
    let det = p * q - r * r;
    let place = [site.x as f64 + 0.5, site.y as f64 + 0.5];
    let [du, dv, ds] = model.slopes.map(|slope| state.lit.contrast * model.lit * slope);
    // the rim next to the site moves with p, q and r as its parameter says
    let [dx, dy] = [place[0] - u, place[1] - v];
    let (c, s) = ((q * dx - r * dy) / det, (p * dy - r * dx) / det);
    let length = (c * c + s * s + 1e-12).sqrt();
    let (c, s) = (c / length, s / length);
    let steep = state.lit.steepness(model.share);
    let [along, down] = [steep * (place[0] - origin[0]), steep * (place[1] - origin[1])];
    [du, dv, c * du, s * dv, s * du + c * dv, ds, model.share * model.lit, model.lit, along, down]
}

/// The weighted normal equations.
pub(super) struct System {
    normal: SiteNormalMatrix,
    right: SiteUnknowns,
    /// Sums of weighted squares and of squares.
    pub squares: [f64; 2],
    /// Sites that count.
    pub used: usize,
}

impl System {
    /// Of the sites that count, at a state whose picture is in the field.
    pub fn of(
        sites: &Sites,
        chosen: &[Site],
        state: &SiteFitState,
        field: &Field,
        origin: [f64; 2],
        by_sample: bool,
    ) -> Self {
        let mut system =
            Self { normal: SiteNormalMatrix::zeros(), right: SiteUnknowns::zeros(), squares: [0.0; 2], used: 0 };
        for site in chosen {
            let model = modelled(site, state, field, origin);
            if !counts(sites, site, model.level, by_sample) {
                continue;
            }
            let weight = 1.0 / sites.noise.variance(model.level);
            let residual = site.light - model.level;
            let row = row(site, state, &model, origin);
            for i in 0..UNKNOWNS {
                let weighted = weight * row[i];
                system.right[i] += weighted * residual;
                for j in 0..=i {
                    system.normal[(i, j)] += weighted * row[j];
                }
            }
            system.squares[0] += weight * residual * residual;
            system.squares[1] += residual * residual;
            system.used += 1;
        }
        system.normal.fill_upper_triangle_with_lower_triangle();
        system
    }

    /// Displacement of the centre by light at the sites that the model does not include, N⁻¹ J'l.
    pub fn pulled(
        &self,
        sites: &Sites,
        chosen: &[Site],
        state: &SiteFitState,
        field: &Field,
        origin: [f64; 2],
        light: impl Fn(f64, f64) -> f64,
    ) -> Option<[f64; 2]> {
        let mut right = SiteUnknowns::zeros();
        for site in chosen {
            let model = modelled(site, state, field, origin);
            if !counts(sites, site, model.level, false) {
                continue;
            }
            let own = light(site.x as f64 + 0.5, site.y as f64 + 0.5) / sites.noise.variance(model.level);
            if own != 0.0 {
                right += own * SiteUnknowns::from(row(site, state, &model, origin));
            }
        }
        Self { right, ..*self }.solve().map(|moved| [moved[0], moved[1]])
    }

    /// Scales of a unit diagonal, and the matrix with a trace of damping for what saturated sites do not determine.
    fn scaled(&self) -> (SiteNormalMatrix, SiteUnknowns) {
        let scale = SiteUnknowns::from_fn(|i, _| 1.0 / self.normal[(i, i)].max(1e-300).sqrt());
        let mut matrix = SiteNormalMatrix::from_fn(|i, j| self.normal[(i, j)] * scale[i] * scale[j]);
        for i in 0..UNKNOWNS {
            matrix[(i, i)] += 1e-7;
        }
        (matrix, scale)
    }

    /// Corrections.
    pub fn solve(&self) -> Option<SiteUnknowns> {
        let (matrix, scale) = self.scaled();
        Some(matrix.cholesky()?.solve(&self.right.component_mul(&scale)).component_mul(&scale))
    }

    /// Covariance of the centre with the given weights.
    pub fn covariance(&self) -> Option<[f64; 3]> {
        let (matrix, scale) = self.scaled();
        let inverse = matrix.cholesky()?.inverse();
        Some([(0, 0), (0, 1), (1, 1)].map(|(i, j)| inverse[(i, j)] * scale[i] * scale[j]))
    }
}
