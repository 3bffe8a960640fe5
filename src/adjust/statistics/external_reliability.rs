//! External reliability: effect of an undetected error of an observation on the points (W. Baarda 1968).
//!
//! A unit of weighted error in the observation with row a shifts the unknowns by Q aᵀ, in the datum by S Q aᵀ. Of an image
//! coordinate the shift of its own point is kept; of a control coordinate that of the control point; of a distance, an
//! observed projection centre or parameter that of the point it moves most: among the ends of the distance, the points
//! of the photo, the points that the camera sees.

use crate::adjust::datum::free::{SIMILARITY, at_point};
use crate::adjust::datum::s_transformation::STransformation;
use crate::adjust::equations::back_substitution::Own;
use crate::adjust::equations::collinearity::CollinearityRows;
use crate::adjust::equations::context::Context;
use crate::adjust::linear::blocks::add_rows;
use crate::adjust::linear::cholesky3::backward3;
use crate::adjust::linear::kernel::TILE;
use crate::adjust::linear::tiles::TileMatrix;
use crate::adjust::problem::additional::distance_row;
use crate::adjust::problem::network::Network;
use crate::adjust::problem::state::State;

/// Length of the largest shift so far, and its point; `usize::MAX` for none.
pub type Largest = (f64, usize);

/// Largest shift caused by a unit error of each given observation, unweighted except for distances.
#[derive(Clone, Debug, Default)]
pub struct ExternalEffects {
    /// Per point and axis of its given coordinates.
    pub points: Vec<[Largest; 3]>,
    /// Per photo and axis of its projection centre.
    pub photos: Vec<[Largest; 3]>,
    /// Per interior orientation and scaled unknown.
    pub interiors: Vec<Vec<Largest>>,
    /// Per distance, by a unit of weighted error.
    pub bars: Vec<Largest>,
}

const NOBODY: Largest = (0.0, usize::MAX);

/// (DᵀG)⁻¹DᵀQ at one point: per direction of the datum a vector over its axes.
pub type DatumCofactors = [[f64; 3]; SIMILARITY];

/// Correction of the shift of a point by the datum: G at the point times (DᵀG)⁻¹DᵀQ aᵀ.
fn align(state: &State, point: usize, taken: &[f64; SIMILARITY], shift: &mut [f64; 3]) {
    for (shift, directions) in shift.iter_mut().zip(at_point(&state.points[point])) {
        *shift -= directions.iter().zip(taken).map(|(g, t)| g * t).sum::<f64>();
    }
}

/// Datum correction for each direction and both coordinates of an observation; the last number is 0.
pub type DatumCorrections = [[f64; 8]; 2];

/// Transforms shifts caused by image coordinates into the datum; the vectors of each unknown are contiguous.
pub struct ShiftTransformation<'a, const N: usize> {
    state: &'a State,
    photos: Vec<[[f64; 8]; 6]>,
    interiors: Vec<[[f64; 8]; N]>,
}

impl<'a, const N: usize> ShiftTransformation<'a, N> {
    /// Lays out the vectors.
    pub fn new(t: &STransformation, Context { network, layout, state, .. }: Context<'a>) -> Self {
        let at = |place: usize| std::array::from_fn(|j| t.v.get(j).map_or(0.0, |v| v[place]));
        let photos = layout.photo.iter().map(|photo| std::array::from_fn(|k| at(photo + k))).collect();
        let interiors = layout.interior.iter().zip(&network.interiors).map(|(place, interior)| {
            std::array::from_fn(|k| if k < interior.estimated.len() { at(place + k) } else { [0.0; 8] })
        });
        Self { state, photos, interiors: interiors.collect() }
    }

    /// V·rowᵀ of both sides over the photo and interior part of a row.
    #[inline(never)]
    pub fn reduced(&self, row: &CollinearityRows<N>) -> DatumCorrections {
        let mut taken = [[0.0; 8]; 2];
        for (side, taken) in taken.iter_mut().enumerate() {
            add_rows::<false, 6, 8>(taken, &row.pose[side], &self.photos[row.photo]);
            if N > 0 {
                add_rows::<false, N, 8>(taken, &row.interior_rows[side], &self.interiors[row.interior]);
            }
        }
        taken
    }

    /// The shifts of a point by the two sides of a ray, of which `taken` is the reduced part and `at_point` the datum's vector
    /// at the point.
    #[inline(never)]
    pub fn align(
        &self,
        (point, at_point): (usize, &DatumCofactors),
        (row, taken): (&CollinearityRows<N>, &DatumCorrections),
        shifts: &mut [[f64; 3]; 2],
    ) {
        for (side, shift) in shifts.iter_mut().enumerate() {
            let mut whole: [f64; SIMILARITY] = std::array::from_fn(|j| taken[side][j]);
            for (whole, at_point) in whole.iter_mut().zip(at_point) {
                *whole += row.point[side].iter().zip(at_point).map(|(a, v)| a * v).sum::<f64>();
            }
            align(self.state, point, &whole, shift);
        }
    }
}

/// Length of a shift over the axes that are not held.
pub fn length(shift: &[f64; 3], fixed: &[bool; 3]) -> f64 {
    (0..3).filter(|a| !fixed[*a]).map(|a| shift[a] * shift[a]).sum::<f64>().sqrt()
}

fn keep(largest: &mut Largest, length: f64, point: usize) {
    if largest.1 == usize::MAX || length > largest.0 {
        *largest = (length, point);
    }
}

/// Source of a point's blocks of the cofactor matrix.
pub struct Blocks<'a> {
    /// The network at its present values.
    pub context: Context<'a>,
    /// The datum, if any.
    pub transformation: Option<&'a STransformation>,
}

impl Blocks<'_> {
    /// Shift of `point` by a unit of the reduced unknown at `place`, from the same without the datum.
    fn in_datum(&self, point: usize, place: usize, mut shift: [f64; 3]) -> f64 {
        if let Some(t) = self.transformation {
            let mut taken = [0.0; SIMILARITY];
            taken.iter_mut().zip(&t.v).for_each(|(taken, v)| *taken = v[place]);
            align(self.context.state, point, &taken, &mut shift);
        }
        length(&shift, &self.context.network.points[point].fixed)
    }

    /// Photos and interior orientations that see a point and have given values.
    fn observed(&self, point: usize) -> (Vec<usize>, Vec<usize>) {
        let network = self.context.network;
        let (mut photos, mut interiors) = (Vec::new(), Vec::new());
        for ray in &network.rays[network.points[point].rays.clone()] {
            let photo = &network.photos[ray.photo];
            if photo.prior.iter().any(|(_, weight)| *weight > 0.0) {
                photos.push(ray.photo);
            }
            let observed = network.interiors[photo.interior].estimated.iter().any(|e| e.prior.1 > 0.0);
            if observed && !interiors.contains(&photo.interior) {
                interiors.push(photo.interior);
            }
        }
        (photos, interiors)
    }
}

impl ExternalEffects {
    /// Every shift.
    pub fn shifts(&self) -> impl Iterator<Item = f64> {
        let given = self.points.iter().chain(&self.photos).flatten();
        given.chain(self.interiors.iter().flatten()).chain(&self.bars).map(|(shift, _)| *shift)
    }

    /// Nothing yet.
    pub fn new(network: &Network) -> Self {
        Self {
            points: vec![[NOBODY; 3]; network.points.len()],
            photos: vec![[NOBODY; 3]; network.photos.len()],
            interiors: network.interiors.iter().map(|i| vec![NOBODY; i.estimated.len()]).collect(),
            bars: Vec::new(),
        }
    }

    /// Given coordinates of the point itself, from its own cofactors.
    pub fn own(&mut self, network: &Network, point: usize, column: impl Fn(usize) -> [f64; 3]) {
        let block = &network.points[point];
        for a in (0..3).filter(|a| block.prior[*a].1 > 0.0) {
            self.points[point][a] = (length(&column(a), &block.fixed), point);
        }
    }

    /// Photos and interior orientations that see an eliminated point, from T = QZ at a photo or interior orientation:
    /// Q_pc = -L⁻ᵀTᵀ.
    pub fn eliminated<const N: usize>(
        &mut self,
        blocks: &Blocks<'_>,
        point: usize,
        l: &[f64; 6],
        at_photo: impl Fn(usize) -> [[f64; 6]; 3],
        at_interiors: (&[Own], &[[[f64; N]; 3]]),
    ) {
        let (photos, interiors) = blocks.observed(point);
        for photo in photos {
            let t = at_photo(photo);
            for a in 0..3 {
                let shift = backward3(l, std::array::from_fn(|m| -t[m][3 + a]));
                let place = blocks.context.layout.photo[photo] + 3 + a;
                keep(&mut self.photos[photo][a], blocks.in_datum(point, place, shift), point);
            }
        }
        for (own, t) in at_interiors.0.iter().zip(at_interiors.1).filter(|(own, _)| interiors.contains(&own.interior)) {
            for n in 0..own.length {
                let shift = backward3(l, std::array::from_fn(|m| -t[m][n]));
                let place = blocks.context.layout.interior[own.interior] + n;
                keep(&mut self.interiors[own.interior][n], blocks.in_datum(point, place, shift), point);
            }
        }
    }

    /// The same for a point kept in the reduced equations.
    pub fn kept(&mut self, blocks: &Blocks<'_>, inverse: &TileMatrix, point: usize) {
        let (photos, interiors) = blocks.observed(point);
        let place = blocks.context.layout.point[point];
        let column = |at: usize| std::array::from_fn(|a| element(inverse, place + a, at));
        for photo in photos {
            for a in 0..3 {
                let at = blocks.context.layout.photo[photo] + 3 + a;
                keep(&mut self.photos[photo][a], blocks.in_datum(point, at, column(at)), point);
            }
        }
        for interior in interiors {
            for (n, largest) in self.interiors[interior].iter_mut().enumerate() {
                let at = blocks.context.layout.interior[interior] + n;
                keep(largest, blocks.in_datum(point, at, column(at)), point);
            }
        }
    }

    /// Distances move their ends.
    pub fn distances(&mut self, blocks: &Blocks<'_>, inverse: &TileMatrix) {
        for bar in &blocks.context.network.bars {
            let (_, rows) = distance_row(blocks.context.network, blocks.context.state, bar);
            let places = [blocks.context.layout.point[bar.from], blocks.context.layout.point[bar.to]];
            let at = |k: usize| places[k / 3] + k % 3;
            let mut taken = [0.0; SIMILARITY];
            for (taken, v) in taken.iter_mut().zip(blocks.transformation.iter().flat_map(|t| &t.v)) {
                *taken = (0..6).map(|k| rows[k] * v[at(k)]).sum();
            }
            let mut largest = NOBODY;
            for (end, place) in [bar.from, bar.to].into_iter().zip(places) {
                let mut shift =
                    std::array::from_fn(|a| (0..6).map(|k| rows[k] * element(inverse, place + a, at(k))).sum());
                align(blocks.context.state, end, &taken, &mut shift);
                keep(&mut largest, length(&shift, &blocks.context.network.points[end].fixed), end);
            }
            self.bars.push(largest);
        }
    }
}

/// An element of the inverse, of which the lower triangle of tiles is kept.
fn element(inverse: &TileMatrix, row: usize, column: usize) -> f64 {
    let crossed = row / TILE < column / TILE;
    let at = if crossed { inverse.place(column, row) } else { inverse.place(row, column) };
    inverse.data()[at]
}
