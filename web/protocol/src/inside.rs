//! Messages about the inside of the adjustment, and its matrices as bytes.

use serde::{Deserialize, Serialize};
use sightline::adjust::{Elimination, Factor, LinearSystem, NormalEquations, SparseMatrix, StepState};
use sightline::adjustment::AdjustOptions;
use sightline::project::{DatumKind, Project};
use sightline_lab::teaching::{Bias, Datums, Explained, Lesson, Planted, Planting, Transformed, Weighted};

/// The matrices and steps shown.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct InsideOf {
    /// Counts the networks of a page: of the same number it is the same network with the same options and start values.
    pub serial: usize,
    /// The project; `None`: the network of the lessons.
    pub project: Option<Project>,
    /// How it is adjusted.
    pub options: AdjustOptions,
    /// By what share of its size the start values are moved.
    pub moved: f64,
}

/// An adjustment after a step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Looked {
    /// Values, corrections, residuals.
    pub state: StepState,
    /// Its equations.
    pub system: LinearSystem,
    /// Their normal equations.
    pub normal: NormalEquations,
    /// Observed values, which differ from those at the start where target centres are corrected for eccentricity.
    #[serde(skip)]
    pub observed: Vec<f64>,
}

/// Where matrices have their entries, which is nearly always the same after every step.
#[derive(Clone, Debug, PartialEq)]
pub struct Places([SparseMatrix; 4]);

impl Places {
    /// Those of a step.
    #[must_use]
    pub fn of(looked: &Looked) -> Self {
        let Looked { system, normal, .. } = looked;
        let without_values = |matrix: &SparseMatrix| SparseMatrix {
            rows: matrix.rows,
            columns: matrix.columns,
            row_starts: matrix.row_starts.clone(),
            column_indices: matrix.column_indices.clone(),
            values: Vec::new(),
        };
        Self([&system.a, &normal.n, &normal.reduced.s, &system.constraints].map(without_values))
    }

    /// Whether N has its entries there.
    #[must_use]
    pub fn has_normal(&self, n: &SparseMatrix) -> bool {
        have_same_places(&self.0[1], n)
    }
}

fn have_same_places(one: &SparseMatrix, other: &SparseMatrix) -> bool {
    one.columns == other.columns && one.row_starts == other.row_starts && one.column_indices == other.column_indices
}

/// Options of an adjustment.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Inquiry {
    /// An observation explained, after so many steps.
    Row {
        /// Steps taken.
        step: usize,
        /// Row of A.
        row: usize,
    },
    /// Standard errors of the unknowns, after so many steps.
    Sigmas(usize),
    /// The Cholesky factor of N, after so many steps.
    Factor {
        /// Steps taken.
        step: usize,
        /// In what order the unknowns are eliminated.
        elimination: Elimination,
    },
    /// The network under three datums, minimal constraints on these points.
    Datums(Option<Vec<String>>),
    /// The covariances of the first datum transformed into the second, minimal constraints on these points.
    Transform([DatumKind; 2], Option<Vec<String>>),
    /// Errors planted in it.
    Plant(Vec<Planting>),
    /// Factors on the standard errors of image and control coordinates.
    Weigh(f64, f64),
    /// Biases of ellipse centres for these diameters.
    Biases(Vec<f64>),
    /// Values of expressions.
    Evaluate(Vec<String>),
    /// The lessons that come with the program.
    Lessons,
    /// A lesson from the text of its file.
    ReadLesson(String),
}

/// The answer to an [`Inquiry`], of the same name.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[expect(missing_docs, reason = "each is the answer to the inquiry of its name")]
pub enum Found {
    Row(Explained),
    Sigmas(Option<Vec<f64>>),
    Factor(Option<Factor>),
    Datums(Datums),
    Transform(Option<Transformed>),
    Plant(Planted),
    Weigh(Weighted),
    Biases(Vec<Bias>),
    Evaluate(Vec<Result<f64, String>>),
    Lessons(Vec<Lesson>),
    ReadLesson(Box<Result<Lesson, String>>),
}

/// Takes matrices and numbers out as bytes: as text they would be many times as long. Without `names` what is the same in every step is
/// left out too: what rows and columns are called, blocks and their order. Of a matrix with its entries at the `places` that the page has
/// already, the values go alone.
pub fn matrices(looked: &mut Looked, names: bool, places: Option<&Places>) -> Vec<Vec<u8>> {
    let Looked { state, system, normal, .. } = looked;
    let all = [&mut system.a, &mut normal.n, &mut normal.reduced.s, &mut system.constraints];
    let packed = all.into_iter().enumerate().map(|(k, matrix)| packed(matrix, places.map(|places| &places.0[k])));
    let mut bytes: Vec<Vec<u8>> = packed.collect();
    let mut numbers = Vec::new();
    let mut put = |values: &mut Vec<f64>| put_values(&mut numbers, &std::mem::take(values));
    [&mut state.values, &mut state.corrections, &mut normal.b].into_iter().for_each(&mut put);
    [&mut state.residuals, &mut system.l, &mut system.p].into_iter().for_each(&mut put);
    put(&mut system.observations.iter().map(|row| row.value).collect());
    put(&mut normal.reduced.b);
    normal.null_space.iter_mut().for_each(|motion| put(&mut motion.vector));
    bytes.push(numbers);
    if !names {
        (system.unknowns, system.observations) = (Vec::new(), Vec::new());
        (normal.blocks, normal.elimination_order) = (Vec::new(), Vec::new());
        normal.reduced.unknowns = Vec::new();
    }
    bytes
}

/// Puts them back except the names; places are those of the `first` step if they were left out. False if the bytes do not fit.
pub fn matrices_from(looked: &mut Looked, bytes: &[impl AsRef<[u8]>], first: Option<&Looked>) -> bool {
    let Looked { state, system, normal, observed } = looked;
    let [matrices @ .., numbers] = bytes else { return false };
    let places = first.map(|first| {
        let Looked { system, normal, .. } = first;
        [&system.a, &normal.n, &normal.reduced.s, &system.constraints]
    });
    let read = |(k, bytes): (usize, &_)| read(AsRef::as_ref(bytes), places.and_then(|all| all.get(k).copied()));
    let read: Option<Vec<SparseMatrix>> = matrices.iter().enumerate().map(read).collect();
    let Some([a, n, s, constraints]) = read.and_then(|all| <[SparseMatrix; 4]>::try_from(all).ok()) else {
        return false;
    };
    let (rows, columns, kept, motions) = (a.rows, a.columns, s.rows, normal.null_space.len());
    (system.a, normal.n, normal.reduced.s, system.constraints) = (a, n, s, constraints);
    let (system_of, normal_of) = first.map_or((&*system, &*normal), |first| (&first.system, &first.normal));
    let named = system_of.observations.len() == rows && system_of.unknowns.len() == columns;
    let numbers = numbers.as_ref();
    if !named
        || normal_of.reduced.unknowns.len() != kept
        || numbers.len() != 8 * (4 * rows + (3 + motions) * columns + kept)
    {
        return false;
    }
    let mut left = numbers;
    let mut take = |count: usize| {
        let (values, rest) = left.split_at(8 * count);
        left = rest;
        values_of(values)
    };
    (state.values, state.corrections, normal.b) = (take(columns), take(columns), take(columns));
    (state.residuals, system.l, system.p) = (take(rows), take(rows), take(rows));
    (*observed, normal.reduced.b) = (take(rows), take(kept));
    normal.null_space.iter_mut().for_each(|motion| motion.vector = take(columns));
    true
}

/// Takes L and its fill-in out as bytes.
pub fn factor_bytes(factor: &mut Factor) -> Vec<Vec<u8>> {
    let filled = std::mem::take(&mut factor.filled);
    vec![packed(&mut factor.l, None), filled.into_iter().map(u8::from).collect()]
}

/// Puts L and its fill-in back; false if the bytes are others.
pub fn factor_from(factor: &mut Factor, bytes: &[impl AsRef<[u8]>]) -> bool {
    let [l, filled] = bytes else { return false };
    let (Some(l), filled) = (read(l.as_ref(), None), filled.as_ref()) else { return false };
    let whole = l.values.len() == filled.len();
    (factor.l, factor.filled) = (l, filled.iter().map(|filled| *filled != 0).collect());
    whole
}

fn put_values(bytes: &mut Vec<u8>, values: &[f64]) {
    let from = bytes.len();
    bytes.resize(from + 8 * values.len(), 0);
    bytes[from..].chunks_exact_mut(8).zip(values).for_each(|(to, value)| to.copy_from_slice(&value.to_le_bytes()));
}

fn values_of(bytes: &[u8]) -> Vec<f64> {
    bytes.chunks_exact(8).map(|b| f64::from_le_bytes([b[0], b[1], b[2], b[3], b[4], b[5], b[6], b[7]])).collect()
}

fn put_counts(bytes: &mut Vec<u8>, counts: &[usize]) {
    let from = bytes.len();
    bytes.resize(from + 4 * counts.len(), 0);
    let places = bytes[from..].chunks_exact_mut(4);
    places.zip(counts).for_each(|(to, count)| to.copy_from_slice(&(*count as u32).to_le_bytes()));
}

fn counts_of(bytes: &[u8]) -> Vec<usize> {
    bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]) as usize).collect()
}

/// Rows, columns and number of entries, row starts and columns, values; or nothing but the values, with no rows named.
fn packed(matrix: &mut SparseMatrix, places: Option<&SparseMatrix>) -> Vec<u8> {
    let matrix = std::mem::take(matrix);
    let count = matrix.values.len();
    let mut bytes = Vec::with_capacity(12 + 4 * (matrix.row_starts.len() + count) + 8 * count);
    if places.is_some_and(|places| have_same_places(places, &matrix)) {
        put_counts(&mut bytes, &[VALUES_ALONE, VALUES_ALONE, count]);
    } else {
        put_counts(&mut bytes, &[matrix.rows, matrix.columns, count]);
        put_counts(&mut bytes, &matrix.row_starts);
        put_counts(&mut bytes, &matrix.column_indices);
    }
    put_values(&mut bytes, &matrix.values);
    bytes
}

/// Stands for rows and columns where only values follow.
const VALUES_ALONE: usize = u32::MAX as usize;

fn read(bytes: &[u8], places: Option<&SparseMatrix>) -> Option<SparseMatrix> {
    let [rows, columns, count] = counts_of(bytes.get(..12)?).try_into().ok()?;
    if [rows, columns] == [VALUES_ALONE; 2] {
        let SparseMatrix { rows, columns, row_starts, column_indices, .. } = places?;
        let values = values_of(bytes.get(12..)?);
        let whole = values.len() == count && count == column_indices.len();
        let (row_starts, column_indices) = (row_starts.clone(), column_indices.clone());
        return whole.then_some(SparseMatrix { rows: *rows, columns: *columns, row_starts, column_indices, values });
    }
    let (starts_end, columns_end) = (4 * (4 + rows), 4 * (4 + rows + count));
    let row_starts = counts_of(bytes.get(12..starts_end)?);
    let column_indices = counts_of(bytes.get(starts_end..columns_end)?);
    let values = values_of(bytes.get(columns_end..)?);
    (values.len() == count).then_some(SparseMatrix { rows, columns, row_starts, column_indices, values })
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::adjust::{linearise, normal_equations, start_adjustment};
    use sightline::project::Datum;
    use sightline_lab::teaching::lab;

    #[test]
    fn matrices_come_back_as_they_went() {
        let (project, options) = (lab().expect("a network"), AdjustOptions::default());
        let project = Project { datum: Datum { kind: DatumKind::Free, points: None }, ..project };
        let looked = Looked {
            state: start_adjustment(&project, &options).expect("a start").state().clone(),
            system: linearise(&project, &options).expect("a system"),
            normal: normal_equations(&project, &options).expect("equations"),
            observed: Vec::new(),
        };
        let places = Places::of(&looked);
        for (names, places) in [(true, None), (false, None), (false, Some(&places))] {
            let mut sent = looked.clone();
            let bytes = matrices(&mut sent, names, places);
            assert_eq!((&sent.system.a, sent.system.observations.is_empty()), (&SparseMatrix::default(), !names));
            let first = (!names).then_some(&looked);
            assert!(matrices_from(&mut sent, &bytes, first));
            assert_eq!(
                (&sent.state, &sent.system.a, &sent.system.l),
                (&looked.state, &looked.system.a, &looked.system.l)
            );
            assert_eq!((&sent.system.constraints, &sent.system.p), (&looked.system.constraints, &looked.system.p));
            assert_eq!((&sent.normal.n, &sent.normal.b), (&looked.normal.n, &looked.normal.b));
            let (reduced, whole) = (&sent.normal.reduced, &looked.normal.reduced);
            assert_eq!(
                (&reduced.s, &reduced.b, &sent.normal.null_space),
                (&whole.s, &whole.b, &looked.normal.null_space)
            );
            assert!(sent.observed.iter().eq(looked.system.observations.iter().map(|row| &row.value)));
            assert!(!names || sent.system == looked.system && sent.normal == looked.normal);
            for k in 0..bytes.len() {
                let mut cut = bytes.clone();
                cut[k].truncate(bytes[k].len().saturating_sub(8));
                assert!(!matrices_from(&mut sent.clone(), &cut, first), "{k}");
            }
        }
    }

    #[test]
    fn a_matrix_with_entries_elsewhere_goes_whole() {
        let dense = SparseMatrix::from_rows(2, [vec![(0, 1.0), (1, 2.0)], vec![(0, 3.0)]]);
        let mut sent = SparseMatrix::from_rows(2, [vec![(1, 2.0)], vec![(0, 3.0), (1, 4.0)]]);
        let (there, bytes) = (sent.clone(), packed(&mut sent, Some(&dense)));
        assert_eq!(read(&bytes, Some(&dense)), Some(there.clone()));
        assert_eq!(read(&packed(&mut there.clone(), Some(&there)), Some(&there)), Some(there.clone()));
        assert_eq!(read(&packed(&mut there.clone(), Some(&there)), None), None);
    }

    #[test]
    fn a_factor_comes_back_as_it_went() {
        let normal = normal_equations(&lab().expect("a network"), &AdjustOptions::default()).expect("equations");
        let factor = normal.cholesky_factor(Elimination::PhotosFirst).expect("regular");
        let mut sent = factor.clone();
        let mut bytes = factor_bytes(&mut sent);
        assert!(sent.l == SparseMatrix::default() && sent.filled.is_empty());
        assert!(factor_from(&mut sent, &bytes));
        assert_eq!(sent, factor);
        bytes[1].pop();
        assert!(!factor_from(&mut sent, &bytes));
    }
}
