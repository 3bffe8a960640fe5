//! Displacement fields over the image by which causes of systematic residuals are modelled.
//!
//! x, y are relative to the principal point, in units of half the image diagonal, ρ² = x² + y², P_j are Legendre's polynomials, and J is
//! the derivative of a ray by the rotation and shift of its photo:
//!
//! | pattern | fields |
//! | --- | --- |
//! | radius | (x, y) P_j(2ρ² - 1), j = 0 … 5 |
//! | tangential | (1, 0), (0, 1), (ρ² + 2x², 2xy), (2xy, ρ² + 2y²), (-y, x) P_j(2ρ² - 1), j = 1, 2 |
//! | affine | (x, -y), (y, x) |
//! | row, column | τJ per photo, τ the row or column from the middle in parts of the image: a uniform motion during the read-out |
//! | position | P_a P_b along u and v, a + b ≤ 5 |
//! | photo | (x, y), (1, 0), (0, 1), (x, y) ρ² per photo |
//! | observation | one image point by itself: a gross error, not a pattern |

use crate::adjust::equations::collinearity::CollinearityRows;
use crate::adjust::problem::network::Network;
use crate::adjust::solve::session::Session;
use crate::project::Camera;

/// Number of fields of the radius.
pub const RADIUS: usize = 6;
/// Number of fields of the tangential pattern.
pub const TANGENTIAL: usize = 6;
/// Number of fields of affinity and shear.
pub const AFFINE: usize = 2;
/// Degree of the smooth pattern of position: shorter waves than a third of the image are not smooth.
const DEGREE: usize = 5;
/// Number of fields of position, with two components.
pub const POSITION: usize = (DEGREE + 1) * (DEGREE + 2);
/// Number of fields of a camera.
const OF_CAMERA: usize = RADIUS + TANGENTIAL + AFFINE + POSITION;
/// Number of fields of a motion.
pub const MOTION: usize = 6;
/// Number of fields of a photo's own interior orientation.
pub const INTERIOR: usize = 4;
/// Number of fields of a photo: motion by row, by column, interior orientation.
const OF_PHOTO: usize = 2 * MOTION + INTERIOR;

/// Position of an observation in the image of its camera.
struct RayPlace {
    /// Index into the tested cameras.
    camera: usize,
    /// Index into the tested photos.
    photo: Option<usize>,
    /// The measurement from the principal point, pixels.
    from_centre: [f64; 2],
    /// The measurement, pixels.
    pixel: [f64; 2],
    /// Half the diagonal of the image, pixels.
    half_diagonal: f64,
    /// Half the width and the height of the image, pixels.
    half_sides: [f64; 2],
    /// Weighted residual per pixel of displacement.
    weight: [f64; 2],
    /// Index into the observations that are tested by themselves.
    single: Option<usize>,
}

/// Displacement fields, numbered: those of the cameras, of the photos, of single observations.
pub struct Basis {
    places: Vec<RayPlace>,
    /// Cameras of the document.
    pub cameras: Vec<usize>,
    /// Photos tested one by one, with their place among the cameras: indices into [`Network::photos`].
    pub photos: Vec<(usize, usize)>,
    /// Number of observations that are tested by themselves.
    pub singles: usize,
}

/// A field's number and its weighted displacement at a ray.
pub type BasisEntry = (usize, [f64; 2]);

/// P_0 … P_n at t.
fn legendre<const N: usize>(t: f64) -> [f64; N] {
    let mut p = [1.0; N];
    if N > 1 {
        p[1] = t;
    }
    for n in 2..N {
        let k = n as f64;
        p[n] = ((2.0 * k - 1.0) * t * p[n - 1] - (k - 1.0) * p[n - 2]) / k;
    }
    p
}

/// The principal point of an adjusted camera, pixels.
fn principal_point(camera: &Camera) -> [f64; 2] {
    let model = camera.interior.model();
    let at = model.centre.map(|p| camera.interior.get(p).unwrap_or_default());
    if model.in_photo_units { camera.pixel_from_photo(at) } else { at }
}

impl Basis {
    /// The fields for a network: `photos` are tested one by one, and so are the rays `singles`.
    pub fn new(session: &Session<'_>, photos: &[usize], singles: &[usize]) -> Self {
        let Network { photos: blocks, interiors, rays, .. } = &session.network;
        let mut cameras: Vec<usize> = interiors.iter().map(|interior| interior.camera).collect();
        cameras.sort_unstable();
        cameras.dedup();
        let number = |photo: usize| {
            let camera = interiors[blocks[photo].interior].camera;
            cameras.iter().position(|c| *c == camera).unwrap_or_default()
        };
        let adjusted: Vec<Camera> = (interiors.iter().zip(&session.state.interiors))
            .map(|(block, interior)| Camera { interior: *interior, ..session.project.cameras[block.camera].clone() })
            .collect();
        let centres: Vec<[f64; 2]> = adjusted.iter().map(principal_point).collect();
        let place = |(k, ray): (usize, &crate::adjust::problem::network::ImageObservation)| {
            let interior = blocks[ray.photo].interior;
            let (camera, centre) = (&adjusted[interior], centres[interior]);
            let (width, height) = (f64::from(camera.width), f64::from(camera.height));
            let observation = &session.project.observations[ray.row];

            let [px, py] = camera.residual_pitch();
            // photo coordinates count upwards
            let per_pixel = [px, if camera.interior.model().in_photo_units { -py } else { py }];
            let robust = session.weights.get(k).copied().unwrap_or([1.0; 2]);
            RayPlace {
                camera: number(ray.photo),
                photo: photos.iter().position(|photo| *photo == ray.photo),
                from_centre: [observation.u - centre[0], observation.v - centre[1]],
                pixel: [observation.u, observation.v],
                half_diagonal: width.hypot(height) / 2.0,
                half_sides: [width / 2.0, height / 2.0],
                weight: std::array::from_fn(|s| per_pixel[s] * ray.sqrt_weight[s] * robust[s]),
                single: singles.iter().position(|single| *single == k),
            }
        };
        Self {
            places: rays.iter().enumerate().map(place).collect(),
            photos: photos.iter().map(|photo| (*photo, number(*photo))).collect(),
            cameras,
            singles: singles.len(),
        }
    }

    /// Number of fields.
    pub fn len(&self) -> usize {
        self.of_single(self.singles).start
    }

    fn of_camera(camera: usize) -> usize {
        camera * OF_CAMERA
    }

    fn of_photo(&self, photo: usize) -> usize {
        self.cameras.len() * OF_CAMERA + photo * OF_PHOTO
    }

    /// Fields of the radius.
    pub fn radius(&self, camera: usize) -> std::ops::Range<usize> {
        let first = Self::of_camera(camera);
        first..first + RADIUS
    }

    /// Tangential fields.
    pub fn tangential(&self, camera: usize) -> std::ops::Range<usize> {
        let first = self.radius(camera).end;
        first..first + TANGENTIAL
    }

    /// Affinity and shear.
    pub fn affine(&self, camera: usize) -> std::ops::Range<usize> {
        let first = self.tangential(camera).end;
        first..first + AFFINE
    }

    /// Smooth fields.
    pub fn position(&self, camera: usize) -> std::ops::Range<usize> {
        let first = self.affine(camera).end;
        first..first + POSITION
    }

    /// Motion of tested photo number `photo` by row, three rotations and three shifts.
    pub fn row(&self, photo: usize) -> std::ops::Range<usize> {
        let first = self.of_photo(photo);
        first..first + MOTION
    }

    /// The same by column.
    pub fn column(&self, photo: usize) -> std::ops::Range<usize> {
        let first = self.row(photo).end;
        first..first + MOTION
    }

    /// Interior orientation of tested photo number `photo`, its scale first.
    pub fn interior(&self, photo: usize) -> std::ops::Range<usize> {
        let first = self.column(photo).end;
        first..first + INTERIOR
    }

    /// Both coordinates of tested observation number `single`.
    pub fn of_single(&self, single: usize) -> std::ops::Range<usize> {
        let first = self.of_photo(self.photos.len()) + 2 * single;
        first..first + 2
    }

    /// Whether a ray belongs to a tested camera, and the pixels per weighted residual there.
    pub fn pixels(&self, ray: usize, camera: usize) -> Option<[f64; 2]> {
        let place = &self.places[ray];
        (place.camera == camera).then(|| place.weight.map(f64::recip))
    }

    /// The weighted fields at a ray that are not zero there.
    pub fn at<const N: usize>(&self, ray: usize, row: &CollinearityRows<N>, entries: &mut Vec<BasisEntry>) {
        entries.clear();
        let place = &self.places[ray];
        let [wx, wy] = place.weight;
        // Fields are evaluated at the adjusted position, not at the measured one: otherwise they would be correlated with the residuals,
        // and where the unknowns absorb the rest of a field only that correlation would remain.
        let off = [row.e[0] / wx, row.e[1] / wy];
        let [x, y]: [f64; 2] = std::array::from_fn(|s| (place.from_centre[s] + off[s]) / place.half_diagonal);
        let [u, v]: [f64; 2] = std::array::from_fn(|s| (place.pixel[s] + off[s]) / place.half_sides[s] - 1.0);
        let square = x * x + y * y;
        let of_radius: [f64; RADIUS] = legendre(2.0 * square - 1.0);
        let mut next = Self::of_camera(place.camera);
        let mut add = |[du, dv]: [f64; 2]| {
            entries.push((next, [wx * du, wy * dv]));
            next += 1;
        };
        of_radius.iter().for_each(|p| add([x * p, y * p]));
        add([1.0, 0.0]);
        add([0.0, 1.0]);
        add([square + 2.0 * x * x, 2.0 * x * y]);
        add([2.0 * x * y, square + 2.0 * y * y]);
        of_radius[1..3].iter().for_each(|p| add([-y * p, x * p]));
        add([x, -y]);
        add([y, x]);
        let (along, down): ([f64; DEGREE + 1], [f64; DEGREE + 1]) = (legendre(u), legendre(v));
        for (a, b) in (0..=DEGREE).flat_map(|a| (0..=DEGREE - a).map(move |b| (a, b))) {
            let p = along[a] * down[b];
            add([p, 0.0]);
            add([0.0, p]);
        }
        if let Some(photo) = place.photo {
            let first = self.row(photo).start;
            for (n, part) in [v / 2.0, u / 2.0].into_iter().enumerate() {
                for m in 0..MOTION {
                    entries.push((first + n * MOTION + m, row.pose.map(|side| part * side[m])));
                }
            }
            let first = self.interior(photo).start;
            let fields = [[x, y], [1.0, 0.0], [0.0, 1.0], [x * square, y * square]];
            entries.extend(fields.iter().enumerate().map(|(k, [du, dv])| (first + k, [wx * du, wy * dv])));
        }
        if let Some(single) = place.single {
            let first = self.of_single(single).start;
            entries.extend([(first, [1.0, 0.0]), (first + 1, [0.0, 1.0])]);
        }
    }
}
