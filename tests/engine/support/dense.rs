//! Plain dense least squares: every parameter in one vector, derivatives by automatic differentiation of the equations as
//! they stand, no elimination.

use nalgebra::{DMatrix, DVector};
use num_dual::{Dual64, DualNum};
use sightline::adjustment::{Adjustment, Given};
use sightline::project::{Camera, DatumKind, Interior, Parameter, Project, Role};

/// Meaning of an entry of the parameter vector.
#[derive(Clone, Debug, PartialEq)]
pub enum Unknown {
    Photo(usize, usize),
    Camera(usize, Parameter),
    Point(usize, usize),
}

/// The problem of an adjusted project: unknowns with their values, and everything known.
pub struct Dense<'a> {
    project: &'a Project,
    adjustment: &'a Adjustment,
    measured: bool,
    pub unknowns: Vec<Unknown>,
    pub values: Vec<f64>,
}

impl<'a> Dense<'a> {
    pub fn new(project: &'a Project, adjustment: &'a Adjustment, measured: bool) -> Self {
        let (mut unknowns, mut values) = (Vec::new(), Vec::new());
        for (k, photo) in adjustment.photos.iter().enumerate() {
            for (n, value) in photo.position.iter().chain(&photo.rotation).enumerate() {
                unknowns.push(Unknown::Photo(k, n));
                values.push(*value);
            }
        }
        for (k, camera) in adjustment.cameras.iter().enumerate() {
            for parameter in camera.camera.estimated() {
                unknowns.push(Unknown::Camera(k, parameter));
                values.push(camera.camera.interior.get(parameter).expect("of the model"));
            }
        }
        for (k, point) in adjustment.points.iter().enumerate() {
            let given = project.points.iter().find(|p| p.id == point.id).expect("of the project");
            let held = |a: usize| {
                project.datum.kind == DatumKind::Control
                    && given.role == Role::Control
                    && !given.sigma.and_then(|s| s[a]).is_some_and(|s| s > 0.0)
            };
            for a in (0..3).filter(|a| !held(*a)) {
                unknowns.push(Unknown::Point(k, a));
                values.push(point.xyz[a]);
            }
        }
        Self { project, adjustment, measured, unknowns, values }
    }

    /// Weighted residuals of all observations at the values, with the derivative in one direction.
    fn residuals(&self, direction: Option<usize>) -> Vec<Dual64> {
        let mut photos: Vec<[Dual64; 6]> = self
            .adjustment
            .photos
            .iter()
            .map(|p| std::array::from_fn(|k| Dual64::from(if k < 3 { p.position[k] } else { p.rotation[k - 3] })))
            .collect();
        let mut points: Vec<[Dual64; 3]> = self.adjustment.points.iter().map(|p| p.xyz.map(Dual64::from)).collect();
        let mut cameras: Vec<Vec<(Parameter, Dual64)>> = self
            .adjustment
            .cameras
            .iter()
            .map(|c| {
                let interior = c.camera.interior;
                let all = interior.parameters().iter().filter(|p| **p != Parameter::F);
                all.map(|p| (*p, Dual64::from(interior.get(*p).expect("known")))).collect()
            })
            .collect();
        if let Some(n) = direction {
            match &self.unknowns[n] {
                Unknown::Photo(k, at) => photos[*k][*at].eps = 1.0,
                Unknown::Point(k, a) => points[*k][*a].eps = 1.0,
                Unknown::Camera(k, Parameter::F) => {
                    let interior = self.adjustment.cameras[*k].camera.interior;
                    let ratio =
                        interior.get(Parameter::Fy).expect("known") / interior.get(Parameter::Fx).expect("known");
                    for (parameter, value) in &mut cameras[*k] {
                        match parameter {
                            Parameter::Fx => value.eps = 1.0,
                            Parameter::Fy => value.eps = ratio,
                            _ => {}
                        }
                    }
                }
                Unknown::Camera(k, parameter) => {
                    cameras[*k].iter_mut().filter(|(p, _)| p == parameter).for_each(|(_, v)| v.eps = 1.0);
                }
            }
        }
        let mut list = Vec::new();
        let photo_at = |id: &str| self.adjustment.photos.iter().position(|p| p.id == id).expect("adjusted");
        let point_at = |id: &str| self.adjustment.points.iter().position(|p| p.id == id).expect("adjusted");
        for o in self.project.observations.iter().filter(|o| o.enabled) {
            let photo = photo_at(&o.photo);
            let camera_id = &self.project.photos.iter().find(|p| p.id == o.photo).expect("known").camera;
            let own = |c: &sightline::adjustment::AdjustedCamera| {
                c.camera.id == *camera_id && c.photo.as_ref().is_none_or(|id| *id == o.photo)
            };
            let camera = self.adjustment.cameras.iter().position(own).expect("adjusted");
            let template = self.project.cameras.iter().find(|c| c.id == *camera_id).expect("known");
            let p = camera_point(&photos[photo], &points[point_at(&o.point)]);
            let e = image_residual(template, &cameras[camera], p, [o.u, o.v], self.measured);
            let sigma = o.sigma.both();
            let unit = if matches!(template.interior, Interior::Brown { .. }) { template.pitch() } else { [1.0; 2] };
            list.extend((0..2).map(|s| e[s] / (sigma[s] * unit[s])));
        }
        let controlled = self.project.datum.kind == DatumKind::Control;
        for given in &self.adjustment.given {
            let e = match &given.what {
                Given::Control { point, axis } => {
                    let known = self.project.points.iter().find(|p| p.id == *point).expect("known").xyz.expect("given");
                    points[point_at(point)][*axis] - known[*axis]
                }
                Given::Position { photo, axis } => {
                    assert!(controlled);
                    let known = self.project.photos.iter().find(|p| p.id == *photo).expect("known");
                    photos[photo_at(photo)][*axis] - known.position.expect("given")[*axis]
                }
                Given::Distance { from, to } => {
                    let d = self.project.distances.iter().find(|d| d.from == *from && d.to == *to).expect("known");
                    let (a, b) = (points[point_at(from)], points[point_at(to)]);
                    let squares = (0..3).map(|k| (a[k] - b[k]).powi(2)).fold(Dual64::from(0.0), |s, x| s + x);
                    squares.sqrt() - d.length
                }
                Given::Parameter { camera, photo, parameter } => {
                    let at = self.adjustment.cameras.iter().position(|c| c.camera.id == *camera && c.photo == *photo);
                    let known = self.project.cameras.iter().find(|c| c.id == *camera).expect("known");
                    let wanted = if *parameter == Parameter::F { Parameter::Fx } else { *parameter };
                    let value =
                        cameras[at.expect("adjusted")].iter().find(|(p, _)| *p == wanted).expect("of the model").1;
                    value - known.interior.get(*parameter).expect("given")
                }
            };
            list.push(e / given.sigma);
        }
        list
    }

    /// Weighted design matrix and residuals: image coordinates in the project's order, then given observations.
    pub fn design(&self) -> (DMatrix<f64>, DVector<f64>) {
        let e: Vec<f64> = self.residuals(None).iter().map(|d| d.re).collect();
        let mut a = DMatrix::zeros(e.len(), self.unknowns.len());
        for n in 0..self.unknowns.len() {
            let column = self.residuals(Some(n));
            a.set_column(n, &DVector::from_iterator(e.len(), column.iter().map(|d| d.eps)));
        }
        (a, DVector::from_vec(e))
    }
}

/// M·(X - XL) with M = Mκ Mφ Mω written out as three turns.
fn camera_point(photo: &[Dual64; 6], x: &[Dual64; 3]) -> [Dual64; 3] {
    let d: [Dual64; 3] = std::array::from_fn(|k| x[k] - photo[k]);
    let (so, co) = photo[3].sin_cos();
    let d = [d[0], co * d[1] + so * d[2], co * d[2] - so * d[1]];
    let (sp, cp) = photo[4].sin_cos();
    let d = [cp * d[0] - sp * d[2], d[1], sp * d[0] + cp * d[2]];
    let (sk, ck) = photo[5].sin_cos();
    [ck * d[0] + sk * d[1], ck * d[1] - sk * d[0], d[2]]
}

fn image_residual(
    camera: &Camera,
    values: &[(Parameter, Dual64)],
    p: [Dual64; 3],
    pixel: [f64; 2],
    measured: bool,
) -> [Dual64; 2] {
    let q = |parameter: Parameter| values.iter().find(|(p, _)| *p == parameter).expect("of the model").1;
    if let Interior::Opencv { .. } = camera.interior {
        let (a, b) = (-p[0] / p[2], p[1] / p[2]);
        let r2 = a * a + b * b;
        let radial = r2 * q(Parameter::K1) + r2 * r2 * q(Parameter::K2) + r2 * r2 * r2 * q(Parameter::K3) + 1.0;
        let (p1, p2) = (q(Parameter::P1), q(Parameter::P2));
        let ad = a * radial + p1 * a * b * 2.0 + p2 * (r2 + a * a * 2.0);
        let bd = b * radial + p1 * (r2 + b * b * 2.0) + p2 * a * b * 2.0;
        return [
            q(Parameter::Fx) * ad + q(Parameter::Cx) - pixel[0],
            q(Parameter::Fy) * bd + q(Parameter::Cy) - pixel[1],
        ];
    }
    let [px, py] = camera.pitch();
    let x = (pixel[0] - f64::from(camera.width) / 2.0) * px;
    let y = (f64::from(camera.height) / 2.0 - pixel[1]) * py;
    let correction = |x: Dual64, y: Dual64| {
        let r2 = x * x + y * y;
        let radial = r2 * q(Parameter::K1) + r2 * r2 * q(Parameter::K2) + r2 * r2 * r2 * q(Parameter::K3);
        let (p1, p2) = (q(Parameter::P1), q(Parameter::P2));
        [
            x * radial + p1 * (r2 + x * x * 2.0) + p2 * x * y * 2.0 + q(Parameter::B1) * x + q(Parameter::B2) * y,
            y * radial + p2 * (r2 + y * y * 2.0) + p1 * x * y * 2.0,
        ]
    };
    let ideal = [-q(Parameter::C) * p[0] / p[2], -q(Parameter::C) * p[1] / p[2]];
    if measured {
        let mut b = ideal;
        for _ in 0..80 {
            let [dx, dy] = correction(b[0], b[1]);
            b = [ideal[0] - dx, ideal[1] - dy];
        }
        return [b[0] + q(Parameter::X0) - x, b[1] + q(Parameter::Y0) - y];
    }
    let (x, y) = (-q(Parameter::X0) + x, -q(Parameter::Y0) + y);
    let [dx, dy] = correction(x, y);
    [ideal[0] - x - dx, ideal[1] - y - dy]
}
