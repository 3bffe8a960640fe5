//! Random calibrations whose photos disagree with the camera model that is estimated, each for one known reason.

use nalgebra::{Rotation3, Vector3};
use sightline::camera::pixel_from_camera_point;
use sightline::noise::Noise;
use sightline::project::{
    Camera, Datum, DatumKind, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma,
};
use sightline::rotation;
use sightline_plan::network::Station;

use super::networks::Uniform;

/// The fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    None,
    /// A lens that the model does not describe: equidistant, stereographic or with a rational distortion.
    Lens,
    /// The camera moves differently during the read-out of every photo, rows one after the other.
    Rows,
    /// The same along the columns.
    Columns,
    /// One photo was refocused: another principal distance, and a little of principal point and distortion.
    Refocused,
    /// One photo is of another size, brought to that of the others, or cropped.
    Size,
    /// Every photo was focused by itself.
    Autofocus,
    /// Decentring that is not estimated.
    Decentring,
    /// Pixels that are not square, estimated as square.
    Affine,
}

/// A scene: what is given to the adjustment, and the same without noise.
pub struct Scene {
    pub project: Project,
    pub exact: Project,
    /// The photo that is the odd one.
    pub odd: Option<String>,
}

/// Distance of the image from the principal point over the principal distance, of a ray θ off the axis.
#[derive(Clone, Copy)]
enum Lens {
    Of(Interior),
    Equidistant,
    Stereographic,
}

fn opencv(f: f64, [cx, cy]: [f64; 2], k: [f64; 3], p: [f64; 2]) -> Interior {
    let (fx, fy) = (Some(f), Some(f));
    Interior::Opencv { fx, fy, cx, cy, k1: k[0], k2: k[1], p1: p[0], p2: p[1], k3: k[2] }
}

/// A scene of a seed with a fault; standard errors and noise of `sigma` pixels.
pub fn scene(fault: Fault, seed: u64, sigma: f64) -> Scene {
    let mut random = Uniform(seed);
    let mut noise = Noise::new(seed, 77);
    let mut between = |low: f64, high: f64| random.between(low, high);
    let (width, height) = [(1280_u32, 960_u32), (4000, 3000), (1920, 1080), (3000, 4000)][between(0.0, 3.999) as usize];
    let (w, h) = (f64::from(width), f64::from(height));
    // 45 to 90 degrees along the diagonal; a lens that is unlike the model is wide
    let tangent = if fault == Fault::Lens { between(0.8, 1.2) } else { between(0.42, 1.0) };
    let f = w.hypot(h) / 2.0 / tangent;
    let centre = [w / 2.0 + 0.01 * w * between(-1.0, 1.0), h / 2.0 + 0.01 * w * between(-1.0, 1.0)];
    let k = [between(-0.15, 0.1), between(-0.03, 0.03), 0.0];
    let decentring = [between(-1e-3, 1e-3), between(-1e-3, 1e-3)];
    let mut truth = opencv(f, centre, k, decentring);
    let kind = between(0.0, 3.0) as usize;
    let mut lens = Lens::Of(truth);
    let mut camera = Camera::new("c", width, height, opencv(f, [w / 2.0, h / 2.0], [0.0; 3], [0.0; 2]));
    let mut free =
        vec![Parameter::F, Parameter::Cx, Parameter::Cy, Parameter::K1, Parameter::K2, Parameter::P1, Parameter::P2];
    match fault {
        Fault::Lens => {
            lens = match kind {
                0 => Lens::Equidistant,
                1 => Lens::Stereographic,
                _ => {
                    let Interior::Opencv { fx, fy, cx, cy, p1, p2, .. } = truth else { unreachable!() };
                    let (k1, k2, k3) = (between(-0.2, 0.2), between(-0.1, 0.1), 0.0);
                    let (k4, k5, k6) = (between(0.3, 1.0), between(0.1, 0.5), between(0.0, 0.2));
                    Lens::Of(Interior::OpencvRational { fx, fy, cx, cy, k1, k2, p1, p2, k3, k4, k5, k6 })
                }
            };
            if between(0.0, 1.0) < 0.5 {
                camera.interior = Interior::brown(f);
                free = "c x0 y0 k1 k2 p1 p2".split(' ').map(|name| name.parse().expect("a parameter")).collect();
            }
        }
        Fault::Decentring => {
            truth = opencv(f, centre, k, [between(1e-3, 6e-3), between(-6e-3, -1e-3)]);
            lens = Lens::Of(truth);
            free.retain(|p| !matches!(p, Parameter::P1 | Parameter::P2));
        }
        Fault::Affine => {
            let mut uneven = truth;
            uneven.set(Parameter::Fy, f * (1.0 + between(0.001, 0.01)));
            lens = Lens::Of(uneven);
        }
        _ => {}
    }
    camera.free = free;
    let photos = between(8.0, 17.0) as usize;
    let points = between(60.0, 160.0) as usize;
    // a calibration field with relief, filling the pictures
    let depth = between(0.1, 0.6);
    let field: Vec<Vector3<f64>> = (0..points)
        .map(|_| Vector3::new(between(-500.0, 500.0), between(-500.0, 500.0), 1000.0 * depth * between(-0.5, 0.5)))
        .collect();
    let odd = between(0.0, photos as f64) as usize;
    let mut project = Project {
        unit: "mm".into(),
        cameras: vec![camera.clone()],
        datum: Datum { kind: DatumKind::Free, points: None },
        ..Project::default()
    };
    let point = |(k, xyz): (usize, &Vector3<f64>)| Point {
        id: k.to_string(),
        role: Role::Tie,
        xyz: Some((*xyz).into()),
        ..Point::default()
    };
    project.points = field.iter().enumerate().map(point).collect();
    // what one size of fault does: from hardly more than the noise to many pixels
    let size = 10f64.powf(between(-0.3, 1.0));
    let mut exact = project.clone();
    for n in 0..photos {
        let turn = n as f64 / photos as f64 * std::f64::consts::TAU + between(-0.2, 0.2);
        let tilt: f64 = between(0.15, 0.8);
        let range = 560.0 / (0.8 * tangent) * between(0.8, 1.1);
        let position = [
            range * tilt.sin() * turn.cos() + between(-60.0, 60.0),
            range * tilt.sin() * turn.sin() + between(-60.0, 60.0),
            range * tilt.cos(),
        ];
        let roll = (n % 4) as f64 * std::f64::consts::FRAC_PI_2 + between(-0.2, 0.2);
        let pose = Station::aimed("s", "c", position, [between(-60.0, 60.0), between(-60.0, 60.0), 0.0], roll)
            .pose()
            .expect("a pose");
        let mut own = lens;
        let mut mapped = [1.0, 0.0, 0.0];
        let changed = |by: f64, shift: [f64; 2], more: f64| {
            Lens::Of(opencv(f * by, [centre[0] + shift[0], centre[1] + shift[1]], [k[0] + more, k[1], 0.0], decentring))
        };
        let by = 1.0 + size * 6.0 / f * if between(0.0, 1.0) < 0.5 { -1.0 } else { 1.0 };
        let shift = [size * between(-3.0, 3.0), size * between(-3.0, 3.0)];
        let more = size * 1e-3 * between(-1.0, 1.0);
        let (is_cropped, scale, [left, top]) =
            (between(0.0, 1.0) < 0.5, between(0.6, 0.98), [0.02 * w * between(0.2, 1.0), 0.02 * h * between(0.2, 1.0)]);
        match fault {
            Fault::Refocused if n == odd => own = changed(by, shift, more),
            Fault::Autofocus => own = changed(1.0 + size * 4.0 / f * between(-1.0, 1.0), [0.0; 2], 0.0),
            Fault::Size if n == odd && is_cropped => mapped = [1.0, -left, -top],
            Fault::Size if n == odd => mapped = [scale, 0.0, 0.0],
            _ => {}
        }
        // turn about the camera axes, radians, and shift in the camera frame, during the whole read-out
        let motion: [f64; 6] = std::array::from_fn(|m| {
            let one = size * 2.0 / f * between(-1.0, 1.0);
            if m < 3 { one } else { one * range * 0.5 }
        });
        let id = format!("s{n}");
        for (k, xyz) in field.iter().enumerate() {
            let of = |part: f64| {
                let moved = pose.to_camera(xyz);
                let turned = Rotation3::new(Vector3::new(motion[0], motion[1], motion[2]) * part) * moved;
                imaged(&own, &camera, f, centre, turned - Vector3::new(motion[3], motion[4], motion[5]) * part)
            };
            let still = pixel_of(of(0.0), mapped);
            let Some(mut pixel) = still else { continue };
            if matches!(fault, Fault::Rows | Fault::Columns) {
                for _ in 0..3 {
                    let part = if fault == Fault::Rows { pixel[1] / h - 0.5 } else { pixel[0] / w - 0.5 };
                    let Some(next) = of(part) else { break };
                    pixel = next;
                }
            }
            let off = [sigma * noise.normal(), sigma * noise.normal()];
            let inside = |p: [f64; 2]| (5.0..w - 5.0).contains(&p[0]) && (5.0..h - 5.0).contains(&p[1]);
            if !inside(pixel) {
                continue;
            }
            let observation = |u, v| Observation {
                photo: id.clone(),
                point: k.to_string(),
                u,
                v,
                sigma: Sigma::One(sigma),
                enabled: true,
                target: None,
            };
            exact.observations.push(observation(pixel[0], pixel[1]));
            project.observations.push(observation(pixel[0] + off[0], pixel[1] + off[1]));
        }
        let photo = Photo {
            id,
            camera: "c".into(),
            position: Some(position),
            rotation: Some(rotation::angles(&pose.object_to_camera)),
            enabled: true,
            ..Photo::default()
        };
        project.photos.push(photo.clone());
        exact.photos.push(photo);
    }
    for project in [&mut project, &mut exact] {
        let mut rays = vec![0; project.points.len()];
        project.observations.iter().for_each(|o| rays[o.point.parse::<usize>().expect("a number")] += 1);
        project.observations.retain(|o| rays[o.point.parse::<usize>().expect("a number")] >= 3);
        project.points.retain(|p| rays[p.id.parse::<usize>().expect("a number")] >= 3);
    }
    let odd = matches!(fault, Fault::Refocused | Fault::Size).then(|| format!("s{odd}"));
    Scene { project, exact, odd }
}

fn pixel_of(pixel: Option<[f64; 2]>, [scale, left, top]: [f64; 3]) -> Option<[f64; 2]> {
    pixel.map(|[u, v]| [scale * u + left, scale * v + top])
}

fn imaged(lens: &Lens, camera: &Camera, f: f64, [cx, cy]: [f64; 2], p: Vector3<f64>) -> Option<[f64; 2]> {
    let across = p.x.hypot(p.y);
    let angle = across.atan2(-p.z);
    let radius = match lens {
        Lens::Of(interior) => {
            return pixel_from_camera_point(&Camera { interior: *interior, ..camera.clone() }, p);
        }
        Lens::Equidistant => f * angle,
        Lens::Stereographic => 2.0 * f * (angle / 2.0).tan(),
    };
    (p.z < 0.0 && across > 0.0).then(|| [cx + radius * p.x / across, cy - radius * p.y / across])
}
