//! The normal equations N δ = AᵀPl, N = AᵀPA, before and after the points are eliminated:
//!
//! ```text
//! | N_rr N_rp | | δ_r |   | b_r |
//! | N_pr N_pp | | δ_p | = | b_p |     S = N_rr - N_rp N_pp⁻¹ N_pr,   b' = b_r - N_rp N_pp⁻¹ b_p,   S δ_r = b'
//! ```
//!
//! with r the photos, interior orientations and points tied by a distance, p all other points. N_pp has a 3 x 3 block a point. Without
//! control N is singular by its datum defect; its null space are the movements of the object that no observation sees.

use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::linear_system::{Columns, LinearSystem, RowNames, of_session};
use super::sparse::SparseMatrix;
use crate::adjust::datum::free::{at_photo, at_point};
use crate::adjust::problem::eccentric;
use crate::adjust::problem::network::Network;
use crate::adjust::solve::session::{Session, unsound};
use crate::adjustment::AdjustOptions;
use crate::error::Result;
use crate::project::Project;

/// The object to which a block of unknowns belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BlockKind {
    /// Exterior orientation of a photo.
    Photo,
    /// Interior orientation.
    Camera,
    /// Object point.
    Point,
}

/// Unknowns that belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Block {
    /// Photo, camera or point.
    pub name: String,
    /// Kind.
    pub kind: BlockKind,
    /// First unknown.
    pub first: usize,
    /// Number of unknowns.
    pub size: usize,
    /// Whether it is eliminated before the reduced equations are set up.
    pub eliminated: bool,
}

/// The reduced normal equations.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Reduced {
    /// Its unknowns, by their places among all.
    pub unknowns: Vec<usize>,
    /// S.
    #[serde(rename = "S")]
    pub s: SparseMatrix,
    /// b'.
    pub b: Vec<f64>,
}

/// Entries of the lower triangle, diagonal included, that differ from zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct FillIn {
    /// Of N.
    pub matrix: usize,
    /// Of its Cholesky factor, points eliminated first.
    pub factor: usize,
    /// Of its Cholesky factor in the order of the unknowns: photos first.
    pub factor_photos_first: usize,
}

/// A movement of the object that no observation sees.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// `shift_x`, `shift_y`, `shift_z`, `rotation_x`, `rotation_y`, `rotation_z` or `scale`; rotations and scale about the object's centre.
    pub name: String,
    /// Change of every unknown by a unit of length, a radian, or a scale of e.
    pub vector: Vec<f64>,
}

/// The normal equations of a document at its present values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NormalEquations {
    /// Blocks of unknowns, in their order.
    pub blocks: Vec<Block>,
    /// N, both triangles.
    #[serde(rename = "N")]
    pub n: SparseMatrix,
    /// AᵀPl.
    pub b: Vec<f64>,
    /// After elimination of the points.
    pub reduced: Reduced,
    /// Blocks in the order in which they are eliminated.
    pub elimination_order: Vec<usize>,
    /// What that costs.
    pub fill_in: FillIn,
    /// Number of unknowns less the datum defect.
    pub rank: usize,
    /// The null space of N.
    pub null_space: Vec<Motion>,
}

/// The normal equations of a document at its present values.
///
/// # Errors
/// As [`crate::adjust::adjust`].
pub fn normal_equations(project: &Project, options: &AdjustOptions) -> Result<NormalEquations> {
    super::stepping::with_session(project, options, |mut session| {
        session.shift = eccentric::shifts(session.project, &session.network, &session.state);
        let system = of_session(&session, options, RowNames::Given)?;
        of_system(&session, options, &system)
    })
}

/// The normal equations of a session's observation equations.
pub(super) fn of_system(
    session: &Session<'_>,
    options: &AdjustOptions,
    system: &LinearSystem,
) -> Result<NormalEquations> {
    let network = &session.network;
    let mut normal = numbers_of_system(session, system, RowNames::Given)?;
    let blocks = &normal.blocks;
    let layout = session.context(options.residuals).layout;
    let mut order: Vec<usize> = (0..blocks.len()).filter(|k| blocks[*k].eliminated).collect();
    let mut kept: Vec<usize> = (0..blocks.len()).filter(|k| !blocks[*k].eliminated).collect();
    let (photos, interiors) = (network.photos.len(), network.interiors.len());
    kept.sort_by_key(|&k| match k {
        _ if k < photos => layout.photo[k],
        _ if k < photos + interiors => layout.interior[k - photos],
        _ => layout.point[k - photos - interiors],
    });
    order.extend(kept);
    let natural: Vec<usize> = (0..blocks.len()).collect();
    let n = &normal.n;
    let neighbours = neighbours(blocks, n);
    normal.fill_in = FillIn {
        matrix: (0..n.rows).map(|row| n.row(row).filter(|(column, _)| *column <= row).count()).sum(),
        factor: factor_entries(blocks, &neighbours, &order),
        factor_photos_first: factor_entries(blocks, &neighbours, &natural),
    };
    normal.elimination_order = order;
    Ok(normal)
}

/// The same without order of elimination and fill-in, which follow from the places of the entries and take longer than their values.
pub(super) fn numbers_of_system(
    session: &Session<'_>,
    system: &LinearSystem,
    names: RowNames,
) -> Result<NormalEquations> {
    let columns = Columns::new(&session.network);
    let blocks = blocks(session, &columns, names);
    let n = system.a.normal(&system.p);
    let b = system.a.transposed_times(&system.p, &system.l);
    let reduced = reduced(&blocks, &n, &b)?;
    let null_space = null_space(session, &columns);
    let rank = columns.count - null_space.len();
    let (elimination_order, fill_in) = (Vec::new(), FillIn::default());
    Ok(NormalEquations { blocks, n, b, reduced, elimination_order, fill_in, rank, null_space })
}

fn blocks(session: &Session<'_>, columns: &Columns, names: RowNames) -> Vec<Block> {
    let (project, network) = (session.project, &session.network);
    let photo_id = |k: usize| &project.photos[network.photos[k].index].id;
    let mut blocks = Vec::new();
    for k in 0..network.photos.len() {
        let first = columns.photo(k).start;
        let name = names.text(|| photo_id(k).clone());
        blocks.push(Block { name, kind: BlockKind::Photo, first, size: 6, eliminated: false });
    }
    for (k, block) in network.interiors.iter().enumerate() {
        let columns = columns.interior(network, k);
        let name = names.text(|| block.photo.map_or(&project.cameras[block.camera].id, photo_id).clone());
        let (first, size) = (columns.start, columns.len());
        blocks.push(Block { name, kind: BlockKind::Camera, first, size, eliminated: false });
    }
    let mut first = blocks.last().map_or(0, |block| block.first + block.size);
    for (k, block) in network.points.iter().enumerate() {
        let size = columns.point(k).count();
        let name = names.text(|| project.points[block.index].id.clone());
        blocks.push(Block { name, kind: BlockKind::Point, first, size, eliminated: !block.kept });
        first += size;
    }
    blocks
}

/// S and its right-hand side, from the entries of N.
fn reduced(blocks: &[Block], n: &SparseMatrix, b: &[f64]) -> Result<Reduced> {
    let kept = blocks.iter().filter(|block| !block.eliminated);
    let unknowns: Vec<usize> = kept.flat_map(|block| block.first..block.first + block.size).collect();
    let mut place = vec![usize::MAX; n.columns];
    unknowns.iter().enumerate().for_each(|(k, unknown)| place[*unknown] = k);
    let mut s = DMatrix::zeros(unknowns.len(), unknowns.len());
    let mut right = DVector::from_iterator(unknowns.len(), unknowns.iter().map(|unknown| b[*unknown]));
    for (row, unknown) in unknowns.iter().enumerate() {
        for (column, value) in n.row(*unknown).filter(|(column, _)| place[*column] != usize::MAX) {
            s[(row, place[column])] += value;
        }
    }
    // Place of a column of S among those beside a point; only those of the present point are read.
    let mut at = vec![0; unknowns.len()];
    // Columns of N_rp that are not empty, and what they have of the point's unknowns.
    let mut beside: Vec<(usize, Vector3<f64>)> = Vec::new();
    for block in blocks.iter().filter(|block| block.eliminated && block.size > 0) {
        let own = block.first..block.first + block.size;
        // A point has up to three unknowns; those that it has not are zero throughout.
        let mut diagonal = Matrix3::identity();
        beside.clear();
        for (k, unknown) in own.clone().enumerate() {
            for (column, value) in n.row(unknown) {
                if own.contains(&column) {
                    diagonal[(k, column - block.first)] = value;
                    continue;
                }
                let column = place[column];
                if beside.get(at[column]).is_none_or(|(other, _)| *other != column) {
                    at[column] = beside.len();
                    beside.push((column, Vector3::zeros()));
                }
                beside[at[column]].1[k] = value;
            }
        }
        let inverse = diagonal.cholesky().ok_or_else(unsound)?.inverse();
        let mut own_b = Vector3::zeros();
        own.enumerate().for_each(|(k, unknown)| own_b[k] = b[unknown]);
        for (row, a) in &beside {
            let carried = inverse * a;
            right[*row] -= carried.dot(&own_b);
            for (column, other) in &beside {
                s[(*column, *row)] -= carried.dot(other);
            }
        }
    }
    let rows = (0..s.nrows()).map(|row| s.row(row).iter().copied().enumerate().collect());
    let s = SparseMatrix::from_rows(unknowns.len(), rows);
    Ok(Reduced { unknowns, s, b: right.as_slice().to_vec() })
}

/// Blocks that share an entry of N, as bits.
fn neighbours(blocks: &[Block], n: &SparseMatrix) -> Vec<Vec<u64>> {
    let mut of = vec![0; n.columns];
    for (k, block) in blocks.iter().enumerate() {
        of[block.first..block.first + block.size].fill(k);
    }
    let mut bits = vec![vec![0u64; blocks.len().div_ceil(64)]; blocks.len()];
    for row in 0..n.rows {
        for (column, _) in n.row(row) {
            bits[of[row]][of[column] / 64] |= 1 << (of[column] % 64);
        }
    }
    bits
}

/// Entries of the Cholesky factor when blocks are eliminated in this order: the neighbours of each become each other's (D. J. Rose 1972).
fn factor_entries(blocks: &[Block], neighbours: &[Vec<u64>], order: &[usize]) -> usize {
    let mut graph = neighbours.to_vec();
    let mut left = vec![u64::MAX; neighbours.first().map_or(0, Vec::len)];
    let mut entries = 0;
    for &k in order {
        left[k / 64] &= !(1 << (k % 64));
        let later: Vec<u64> = graph[k].iter().zip(&left).map(|(bits, left)| bits & left).collect();
        let later_blocks: Vec<usize> = (0..blocks.len()).filter(|j| later[j / 64] >> (j % 64) & 1 == 1).collect();
        let size = blocks[k].size;
        let below: usize = later_blocks.iter().map(|j| blocks[*j].size).sum();
        entries += size * (size + 1) / 2 + size * below;
        for &j in &later_blocks {
            graph[j].iter_mut().zip(&later).for_each(|(bits, more)| *bits |= more);
        }
    }
    entries
}

const MOTIONS: [&str; 7] = ["shift_x", "shift_y", "shift_z", "rotation_x", "rotation_y", "rotation_z", "scale"];

/// Movements that change no observation, in the units of the unknowns; none under control.
fn null_space(session: &Session<'_>, columns: &Columns) -> Vec<Motion> {
    let (network, state) = (&session.network, &session.state);
    let Network { frame, .. } = network;
    let defect = session.datum.as_ref().map_or(0, |datum| datum.defect);
    let motion = |j: usize| {
        // Inside, a shift is counted in the frame's scale.
        let length = if j < 3 { 1.0 } else { frame.scale };
        let mut vector = vec![0.0; columns.count];
        for (k, pose) in state.poses.iter().enumerate() {
            let rows = at_photo(&pose.m, &pose.centre);
            for (n, column) in columns.photo(k).enumerate() {
                vector[column] = rows[n][j] * if n < 3 { 1.0 } else { length };
            }
        }
        for (k, x) in state.points.iter().enumerate() {
            columns.point(k).zip(at_point(x)).for_each(|(column, row)| vector[column] = row[j] * length);
        }
        Motion { name: MOTIONS[j].to_owned(), vector }
    };
    (0..defect).map(motion).collect()
}
