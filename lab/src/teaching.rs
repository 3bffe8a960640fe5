//! The adjustment for students: a small network, one observation explained, datums and estimators compared, the effect of a weight or of a
//! target's size, and the quantities for lessons. Every number is one of the adjustment's own or follows from its matrices.

mod datums;
mod dense;
mod eccentric;
mod explained;
mod files;
mod lab;
mod lesson;
mod planted;
mod progress;
mod transformed;
mod values;
mod weights;

pub use datums::{DatumCase, Datums, Motion, datums};
pub use dense::{LARGEST, cofactors, sigmas};
pub use eccentric::{Bias, biases};
pub use explained::{Collinearity, Derivative, Explained, explain};
pub use files::files;
pub use lab::{lab, moved};
pub use lesson::{Choice, LESSON_FORMAT, Lesson, LessonStep, Piece, Question, Screen, Show, Words, lessons, pieces};
pub use planted::{Estimate, Planted, Planting, Tested, plant};
pub use progress::{LessonProgress, PROGRESS_FORMAT, Reached};
pub use transformed::{Transformed, TransformedPoint, transformed};
pub use values::{NAMES, evaluate};
pub use weights::{Weighted, weighted};
