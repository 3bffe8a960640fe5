//! The adjustment laid open: what is asked of it, and its matrices as bytes.

use serde::{Deserialize, Serialize};
use sightline::adjust::{LinearSystem, NormalEquations, SparseMatrix, StepState};
use sightline::adjustment::AdjustOptions;
use sightline::project::Project;
use sightline::teaching::{Bias, Datums, Explained, Lesson, Planted, Planting, Weighted};

/// What is laid open.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct InsideOf {
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
}

/// What is asked of an adjustment.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Inquiry {
    /// An observation explained, after so many steps.
    Row {
        /// Steps taken.
        step: usize,
        /// Row of A.
        row: usize,
    },
    /// The network under three datums, minimal constraints on these points.
    Datums(Option<Vec<String>>),
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
    Datums(Datums),
    Plant(Planted),
    Weigh(Weighted),
    Biases(Vec<Bias>),
    Evaluate(Vec<Result<f64, String>>),
    Lessons(Vec<Lesson>),
    ReadLesson(Box<Result<Lesson, String>>),
}

/// Takes A, N and S out as bytes: as text they would be many times as long.
pub fn matrices(looked: &mut Looked) -> Vec<Vec<u8>> {
    let all = [&mut looked.system.a, &mut looked.normal.n, &mut looked.normal.reduced.s];
    all.map(|matrix| {
        let matrix = std::mem::take(matrix);
        let mut bytes = Vec::with_capacity(16 + 4 * matrix.row_starts.len() + 12 * matrix.values.len());
        let mut number = |number: usize| bytes.extend((number as u32).to_le_bytes());
        [matrix.rows, matrix.columns, matrix.values.len()].into_iter().for_each(&mut number);
        matrix.row_starts.iter().chain(&matrix.column_indices).copied().for_each(number);
        matrix.values.iter().for_each(|value| bytes.extend(value.to_le_bytes()));
        bytes
    })
    .into()
}

/// Puts A, N and S back; false where the bytes are others.
pub fn matrices_from(looked: &mut Looked, bytes: &[impl AsRef<[u8]>]) -> bool {
    let [a, n, s] = bytes else { return false };
    let read = |bytes: &[u8]| {
        let number = |k: usize| Some(u32::from_le_bytes(bytes.get(4 * k..4 * k + 4)?.try_into().ok()?) as usize);
        let (rows, columns, count) = (number(0)?, number(1)?, number(2)?);
        let numbers = |from: usize, many: usize| (from..from + many).map(number).collect::<Option<Vec<_>>>();
        let (row_starts, column_indices) = (numbers(3, rows + 1)?, numbers(4 + rows, count)?);
        let values = bytes.get(4 * (4 + rows + count)..)?.chunks_exact(8);
        let values: Vec<f64> = values.filter_map(|value| Some(f64::from_le_bytes(value.try_into().ok()?))).collect();
        (values.len() == count).then_some(SparseMatrix { rows, columns, row_starts, column_indices, values })
    };
    let (Some(a), Some(n), Some(s)) = (read(a.as_ref()), read(n.as_ref()), read(s.as_ref())) else { return false };
    (looked.system.a, looked.normal.n, looked.normal.reduced.s) = (a, n, s);
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use sightline::adjust::{linearise, normal_equations, start_adjustment};
    use sightline::teaching::lab;

    #[test]
    fn matrices_come_back_as_they_went() {
        let (project, options) = (lab().expect("a network"), AdjustOptions::default());
        let looked = Looked {
            state: start_adjustment(&project, &options).expect("a start").state().clone(),
            system: linearise(&project, &options).expect("a system"),
            normal: normal_equations(&project, &options).expect("equations"),
        };
        let mut sent = looked.clone();
        let bytes = matrices(&mut sent);
        assert_eq!(sent.system.a, SparseMatrix::default());
        assert!(matrices_from(&mut sent, &bytes));
        assert_eq!((&sent.system.a, &sent.normal.n), (&looked.system.a, &looked.normal.n));
        assert_eq!(sent.normal.reduced, looked.normal.reduced);
        let mut cut = bytes.clone();
        cut[1].pop();
        assert!(!matrices_from(&mut looked.clone(), &cut));
    }
}
