//! Doubtful matches as questions: is this target that point? Each answer is one step.

use std::sync::Arc;

use sightline::matching::{Doubt, Doubtful};
use sightline::project::{Observation, Sigma};

use super::points::{self, BY_HAND_SIGMA};
use crate::document::Document;

/// Whether a place of a photo is a point; without one, which point it is.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    pub photo: String,
    pub place: [f64; 2],
    /// Number of the target there.
    pub target: Option<u32>,
    pub point: Option<String>,
    pub reason: Doubt,
}

/// All open questions: those with a point to say yes to first, photo by photo.
pub fn open(document: &Document) -> Vec<Question> {
    let mut questions = Vec::new();
    for doubtful in document.doubtful.iter().filter(|d| !is_named(document, d)) {
        let ask = |point: Option<&String>| Question {
            photo: doubtful.photo.clone(),
            place: [doubtful.u, doubtful.v],
            target: doubtful.target,
            point: point.cloned(),
            reason: doubtful.reason,
        };
        if doubtful.points.is_empty() {
            questions.push(ask(None));
        }
        questions.extend(doubtful.points.iter().map(|point| ask(Some(point))));
    }
    questions.sort_by_key(|q| q.point.is_none());
    questions
}

/// A target that has a name by now is in doubt no more.
fn is_named(document: &Document, doubtful: &Doubtful) -> bool {
    doubtful.target.is_some_and(|id| points::observation_of(&document.project, &doubtful.photo, id).is_some())
}

fn same(doubtful: &Doubtful, question: &Question) -> bool {
    doubtful.photo == question.photo && [doubtful.u, doubtful.v] == question.place && doubtful.target == question.target
}

/// The place is this point: it is measured there, and nowhere else in the photo.
pub fn yes(document: &mut Document, question: &Question, point: &str) {
    let found = question.target.and_then(|id| document.detections.get(&question.photo)?.target(id).cloned());
    let ([u, v], sigma) = match &found {
        Some(t) => ([t.u, t.v], Sigma::Two([t.sigma_u, t.sigma_v])),
        None => (question.place, Sigma::One(BY_HAND_SIGMA)),
    };
    let (photo, point) = (question.photo.clone(), point.to_owned());
    let target = found.and_then(|t| t.number());
    let rival = |d: &Doubtful| d.photo == question.photo && d.points == [point.clone()];
    let doubtful = Arc::make_mut(&mut document.doubtful);
    doubtful.retain(|d| !same(d, question) && !rival(d));
    for d in doubtful.iter_mut().filter(|d| d.photo == question.photo) {
        d.points.retain(|other| *other != point);
    }
    points::observe(document.project_mut(), Observation { photo, point, u, v, sigma, enabled: true, target });
}

/// The place is not this point, or has no name: it is asked no more.
pub fn no(document: &mut Document, question: &Question) {
    let doubtful = Arc::make_mut(&mut document.doubtful);
    if let Some(point) = &question.point {
        for d in doubtful.iter_mut().filter(|d| same(d, question)) {
            d.points.retain(|other| other != point);
        }
    }
    doubtful.retain(|d| !(same(d, question) && (question.point.is_none() || d.points.is_empty())));
}

#[cfg(test)]
mod tests {
    use super::*;

    fn doubtful(photo: &str, target: u32, points: &[&str], reason: Doubt) -> Doubtful {
        let points = points.iter().map(|p| (*p).to_owned()).collect();
        Doubtful { photo: photo.into(), u: f64::from(target), v: 1.0, target: Some(target), points, reason }
    }

    fn document() -> Document {
        Document {
            doubtful: Arc::new(vec![
                doubtful("1", 4, &[], Doubt::Ambiguous),
                doubtful("1", 1, &["a", "b"], Doubt::Ambiguous),
                doubtful("1", 2, &["a"], Doubt::DuplicateCode),
            ]),
            ..Document::default()
        }
    }

    #[test]
    fn questions_with_an_answer_come_first() {
        let asked = open(&document()).into_iter().map(|q| (q.target, q.point)).collect::<Vec<_>>();
        let point = |p: &str| Some(p.to_owned());
        assert_eq!(asked, [(Some(1), point("a")), (Some(1), point("b")), (Some(2), point("a")), (Some(4), None)]);
    }

    #[test]
    fn yes_measures_the_point_and_answers_its_rivals() {
        let mut d = document();
        let question = open(&d)[0].clone();
        yes(&mut d, &question, "a");
        assert_eq!((d.project.observations.len(), d.project.observations[0].u), (1, 1.0));
        assert_eq!(open(&d).into_iter().map(|q| q.target).collect::<Vec<_>>(), [Some(4)]);
    }

    #[test]
    fn no_leaves_the_other_points_to_be_asked() {
        let mut d = document();
        let question = open(&d)[0].clone();
        no(&mut d, &question);
        assert_eq!(open(&d)[0].point.as_deref(), Some("b"));
        for question in open(&d) {
            no(&mut d, &question);
        }
        assert!(open(&d).is_empty() && d.project.observations.is_empty());
    }
}
