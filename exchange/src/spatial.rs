//! Contents of drawings and 3-D files: adjusted points, or the document's own without an adjustment, cameras, lines.

use std::collections::HashMap;

use nalgebra::Matrix3;

use sightline::adjustment::{Adjustment, MeasuredFeature};
use sightline::depiction::{Drawn, drawn, ellipsoid, exaggeration, extent, frustum};
use sightline::project::{Point, Project, Role};

/// A point as it is drawn.
pub struct Spot<'a> {
    pub point: &'a Point,
    pub xyz: [f64; 3],
    pub sigma: Option<[f64; 3]>,
    pub rays: usize,
    /// Carries the unit sphere onto the error ellipsoid.
    pub ellipsoid: Option<Matrix3<f64>>,
}

/// A photo as it is drawn.
pub struct View<'a> {
    pub id: &'a str,
    /// Projection centre and corners.
    pub frustum: [[f64; 3]; 5],
}

/// Everything that is drawn.
pub struct Spatial<'a> {
    pub spots: Vec<Spot<'a>>,
    pub views: Vec<View<'a>>,
    /// Measurements on the result.
    pub features: Vec<(&'a MeasuredFeature, Drawn)>,
    /// Middle of the points.
    pub centre: [f64; 3],
    /// Diagonal of the box around the points.
    pub size: f64,
    /// Exaggeration of the ellipsoids.
    pub factor: f64,
}

impl<'a> Spatial<'a> {
    pub fn of(project: &'a Project, adjustment: Option<&'a Adjustment>) -> Self {
        let adjusted: HashMap<&str, _> =
            adjustment.iter().flat_map(|a| &a.points).map(|p| (p.id.as_str(), p)).collect();
        let spot = |point: &'a Point| match adjusted.get(point.id.as_str()) {
            Some(found) => Some(Spot {
                point,
                xyz: found.xyz,
                sigma: found.sigma,
                rays: found.rays,
                ellipsoid: found.covariance.map(ellipsoid),
            }),
            None => Some(Spot { point, xyz: point.xyz?, sigma: None, rays: 0, ellipsoid: None }),
        };
        let spots: Vec<Spot> = project.points.iter().filter_map(spot).collect();
        let (centre, size) = extent(spots.iter().map(|s| s.xyz));
        let factor = exaggeration(spots.iter().filter_map(|s| s.sigma).map(|[x, y, z]| x.max(y).max(z)), size);
        let oriented: HashMap<&str, _> =
            adjustment.iter().flat_map(|a| &a.photos).map(|p| (p.id.as_str(), (p.position, p.rotation))).collect();
        let view = |photo: &'a sightline::project::Photo| {
            let own = || Some((photo.position?, photo.rotation?));
            let (position, rotation) = oriented.get(photo.id.as_str()).copied().or_else(own)?;
            let camera = project.cameras.iter().find(|c| c.id == photo.camera)?;
            Some(View { id: &photo.id, frustum: frustum(camera, position, rotation, 0.1 * size)? })
        };
        let views = project.photos.iter().filter(|p| p.enabled).filter_map(view).collect();
        let place = |id: &str| adjusted.get(id).map(|p| p.xyz);
        let measured = adjustment.iter().flat_map(|a| &a.features).filter(|f| f.error.is_none());
        let features = measured
            .map(|f| (f, drawn(f, &f.residuals.iter().filter_map(|r| place(&r.point)).collect::<Vec<_>>())))
            .collect();
        Self { spots, views, features, centre, size, factor }
    }
}

/// Colours of roles: tie points blue, control orange, check green.
pub fn colour(role: Role) -> [u8; 3] {
    match role {
        Role::Tie => [0, 94, 184],
        Role::Control => [190, 80, 0],
        Role::Check => [0, 120, 60],
    }
}

/// Corners and triangles of a unit sphere, seen from outside: an octahedron whose faces are divided twice.
pub fn sphere() -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut corners: Vec<[f64; 3]> =
        vec![[1., 0., 0.], [-1., 0., 0.], [0., 1., 0.], [0., -1., 0.], [0., 0., 1.], [0., 0., -1.]];
    let mut faces: Vec<[u32; 3]> =
        vec![[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]];
    for _ in 0..2 {
        let mut known = HashMap::new();
        let mut middle = |a: u32, b: u32, corners: &mut Vec<[f64; 3]>| {
            *known.entry((a.min(b), a.max(b))).or_insert_with(|| {
                let (p, q) = (corners[a as usize], corners[b as usize]);
                let sum: [f64; 3] = std::array::from_fn(|k| p[k] + q[k]);
                let length = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
                corners.push(sum.map(|x| x / length));
                corners.len() as u32 - 1
            })
        };
        let divided = faces.iter().flat_map(|&[a, b, c]| {
            let [d, e, f] = [middle(a, b, &mut corners), middle(b, c, &mut corners), middle(c, a, &mut corners)];
            [[a, d, f], [d, b, e], [f, e, c], [d, e, f]]
        });
        faces = divided.collect();
    }
    (corners, faces)
}
