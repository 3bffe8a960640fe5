//! Random networks with known truth: convergent photos around a cloud of points.

use nalgebra::{Matrix3, Vector3};
use sightline::camera;
use sightline::noise::Noise;
use sightline::project::{
    Camera, Datum, DatumKind, Distance, Interior, Observation, Parameter, Photo, Point, Project, Role, Sigma,
};
use sightline::rotation;

/// Parameters of a random network.
#[derive(Clone, Debug)]
pub struct Wanted {
    pub photos: usize,
    pub points: usize,
    pub cameras: Vec<Camera>,
    pub datum: DatumKind,
    /// Points of the inner constraints or minimal ones.
    pub datum_points: Option<Vec<String>>,
    /// Control points, and their sigma on every axis (0: fixed).
    pub control: (usize, f64),
    /// Distances between the first points, with this sigma.
    pub distances: (usize, f64),
    /// Sigma of observed projection centres; 0 for none.
    pub centre_sigma: f64,
    /// Sigma of image coordinates in pixels, also of the noise.
    pub sigma_px: f64,
    /// Whether the points reach beyond the pictures' edges, near and far: what a photo does not show is not measured in it.
    pub wide: bool,
}

pub fn brown(free: &[Parameter]) -> Camera {
    Camera {
        id: "brown".into(),
        width: 4000,
        height: 3000,
        pixel_pitch: Some([0.005, 0.005]),
        interior: Interior::Brown {
            c: Some(20.0),
            x0: 0.05,
            y0: -0.04,
            k1: 1e-4,
            k2: -2e-7,
            k3: 1e-10,
            p1: 1e-5,
            p2: -2e-5,
            b1: 1e-4,
            b2: -5e-5,
        },
        free: free.to_vec(),
        sigma: Default::default(),
        per_photo: false,
    }
}

pub fn opencv(free: &[Parameter]) -> Camera {
    Camera {
        id: "opencv".into(),
        width: 4000,
        height: 3000,
        pixel_pitch: None,
        interior: Interior::Opencv {
            fx: Some(4000.0),
            fy: Some(4010.0),
            cx: 2010.0,
            cy: 1490.0,
            k1: -0.1,
            k2: 0.05,
            p1: 1e-4,
            p2: -2e-4,
            k3: 0.0,
        },
        free: free.to_vec(),
        sigma: Default::default(),
        per_photo: false,
    }
}

impl Default for Wanted {
    fn default() -> Self {
        Self {
            photos: 6,
            points: 16,
            cameras: vec![brown(&[Parameter::C, Parameter::X0, Parameter::Y0, Parameter::K1])],
            datum: DatumKind::Free,
            datum_points: None,
            control: (0, 0.0),
            distances: (0, 0.0),
            centre_sigma: 0.0,
            sigma_px: 0.2,
            wide: false,
        }
    }
}

/// Numbers between two limits, the same on every machine (splitmix64).
pub struct Uniform(pub u64);

impl Uniform {
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + (high - low) * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// The network without noise: every value is the truth and the observations are exact.
pub fn exact(wanted: &Wanted, seed: u64) -> Project {
    let mut random = Uniform(seed);
    let mut project = Project {
        cameras: wanted.cameras.clone(),
        datum: Datum { kind: wanted.datum, points: wanted.datum_points.clone() },
        ..Project::default()
    };
    for k in 0..wanted.points {
        let halves = if wanted.wide { [800.0, 800.0, 400.0] } else { [400.0, 300.0, 150.0] };
        let xyz = halves.map(|half| random.between(-half, half));
        let control = k < wanted.control.0;
        project.points.push(Point {
            id: format!("p{k}"),
            role: if control { Role::Control } else { Role::Tie },
            xyz: Some(xyz),
            sigma: control.then_some([Some(wanted.control.1); 3]),
            ..Point::default()
        });
    }
    for i in 0..wanted.photos {
        let azimuth = std::f64::consts::TAU * (i as f64 + random.between(0.0, 0.2)) / wanted.photos as f64;
        let elevation = random.between(0.6, 1.2);
        let distance = random.between(1400.0, 1700.0);
        let centre =
            Vector3::new(azimuth.cos() * elevation.cos(), azimuth.sin() * elevation.cos(), elevation.sin()) * distance;
        let z = centre.normalize();
        let x = Vector3::z().cross(&z).normalize();
        let roll = std::f64::consts::FRAC_PI_2 * (i % 4) as f64 + random.between(-0.1, 0.1);
        let x = x * roll.cos() + z.cross(&x) * roll.sin();
        let m = Matrix3::from_rows(&[x.transpose(), z.cross(&x).transpose(), z.transpose()]);
        let camera = &project.cameras[i % project.cameras.len()];
        let id = format!("f{i}");
        for point in &project.points {
            let p = m * (Vector3::from(point.xyz.expect("known")) - centre);
            let [u, v] = camera::pixel_from_camera_point(camera, p).expect("in front");
            if !(u > 0.0 && v > 0.0 && u < 4000.0 && v < 3000.0) {
                assert!(wanted.wide, "outside the photo: {u} {v}");
                continue;
            }
            project.observations.push(Observation {
                photo: id.clone(),
                point: point.id.clone(),
                u,
                v,
                sigma: Sigma::One(wanted.sigma_px),
                enabled: true,
                target: None,
            });
        }
        project.photos.push(Photo {
            id,
            camera: camera.id.clone(),
            position: Some(centre.into()),
            rotation: Some(rotation::angles(&m)),
            sigma_position: (wanted.centre_sigma > 0.0).then_some([Some(wanted.centre_sigma); 3]),
            enabled: true,
            ..Photo::default()
        });
    }
    let rays = |id: &String| project.observations.iter().filter(|o| o.point == *id).count();
    let lone: Vec<String> =
        project.points.iter().map(|p| p.id.clone()).filter(|id| wanted.wide && rays(id) < 3).collect();
    project.points.retain(|p| !lone.contains(&p.id));
    project.observations.retain(|o| !lone.contains(&o.point));
    for k in 0..wanted.distances.0 {
        let ends = [&project.points[2 * k], &project.points[2 * k + 1]];
        let [a, b] = ends.map(|p| Vector3::from(p.xyz.expect("known")));
        project.distances.push(Distance {
            from: ends[0].id.clone(),
            to: ends[1].id.clone(),
            length: (b - a).norm(),
            sigma: wanted.distances.1,
            check: false,
        });
    }
    project
}

/// The same with noise on every observation, of the size of its sigma.
pub fn noisy(exact: &Project, random: &mut Noise) -> Project {
    let mut project = exact.clone();
    for o in &mut project.observations {
        let [su, sv] = o.sigma.both();
        o.u += su * random.normal();
        o.v += sv * random.normal();
    }
    let controlled = project.datum.kind == DatumKind::Control;
    for point in project.points.iter_mut().filter(|p| controlled && p.role == Role::Control) {
        if let (Some(xyz), Some(sigma)) = (&mut point.xyz, point.sigma) {
            (0..3).for_each(|a| xyz[a] += sigma[a].unwrap_or(0.0) * random.normal());
        }
    }
    for photo in project.photos.iter_mut().filter(|_| controlled) {
        if let (Some(position), Some(sigma)) = (&mut photo.position, photo.sigma_position) {
            (0..3).for_each(|a| position[a] += sigma[a].unwrap_or(0.0) * random.normal());
        }
    }
    for distance in &mut project.distances {
        distance.length += distance.sigma * random.normal();
    }
    for camera in &mut project.cameras {
        for (parameter, sigma) in camera.sigma.clone() {
            let value = camera.interior.get(parameter).unwrap_or_default();
            camera.interior.set(parameter, value + sigma * random.normal());
        }
    }
    project
}
