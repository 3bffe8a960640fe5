//! Incoming text files: sorted by content and passed to their step.

use std::collections::{BTreeSet, VecDeque};
use std::rc::Rc;

use leptos::prelude::*;
use leptos::task::spawn_local;
use sightline::project::Project;
use sightline_exchange::comparator;
use sightline_exchange::control_csv::ListFormat;
use sightline_exchange::lists::{self, distances};
use sightline_exchange::{Files, Row, control_csv, encoding, rows};

use super::{Asking, Desk, Problem, Reason, Step, Until};
use crate::browser::file::NamedFile;
use crate::i18n::{lists as lists_words, name_list, text};

/// Kinds of lists that a text can be read as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ListKind {
    /// Marks of an earlier measurement: photo, point, u, v.
    Marks,
    /// Control points: id, X, Y, Z.
    Control,
    /// Distances: from, to, length.
    Distances,
}

/// A list of points or distances that waits for the one before it.
#[derive(Clone, Debug, PartialEq)]
pub struct NextList {
    name: String,
    bytes: Vec<u8>,
    content: String,
    kind: ListKind,
}

/// Share of a text's rows that have to be of a kind: a few bad ones are named when it is read.
const MOST: f64 = 0.5;

/// The ways in which a text can be read beside this project: none for prose, two where they cannot be distinguished.
pub fn readings(text: &str, project: &Project) -> Vec<ListKind> {
    if lists::recognised(text) != ListFormat::Table {
        return vec![ListKind::Control];
    }
    let known = project.points.iter().map(|point| point.id.as_str()).collect();
    if distances::recognises(text, &known) {
        return vec![ListKind::Distances];
    }
    let rows = rows(text);
    let Some(first) = rows.first() else { return Vec::new() };
    let names = |wanted: &[&str]| {
        wanted.iter().all(|name| {
            first.fields.iter().any(|field| {
                let word = field.split(['[', '(', ' ']).next().unwrap_or_default();
                word.eq_ignore_ascii_case(name)
            })
        })
    };
    let table = control_csv::parse(text);
    let good = table.rows.iter().filter(|row| row.is_ok()).count();
    let control = good > 0 && good as f64 >= MOST * table.rows.len() as f64 || table.is_open();
    if control && (table.has_heading() || names(&["x", "y", "z"])) {
        return vec![ListKind::Control];
    }
    let marks: Vec<&Row> = rows.iter().filter(|row| is_mark(row)).collect();
    let some = !marks.is_empty() && marks.len() as f64 >= MOST * rows.len() as f64;
    match (some, control) {
        (false, false) => Vec::new(),
        (true, false) => vec![ListKind::Marks],
        (false, true) => vec![ListKind::Control],
        (true, true) => told_apart(&marks, project),
    }
}

/// Rows of four or five numbers are both. Control points are named once; marks name photos, and points without decimals.
fn told_apart(marks: &[&Row], project: &Project) -> Vec<ListKind> {
    let firsts: BTreeSet<&str> = marks.iter().map(|row| row.fields[0].as_str()).collect();
    if firsts.len() < marks.len() {
        return vec![ListKind::Marks];
    }
    let photo = |name: &str| {
        project.photos.iter().any(|p| p.id == name || p.file.split('.').next() == Some(name) || p.file == name)
    };
    let foreign = !project.photos.is_empty() && !firsts.iter().any(|name| photo(name));
    let decimal = marks.iter().any(|row| row.fields[1].contains(['.', ',']));
    if foreign || decimal { vec![ListKind::Control] } else { vec![ListKind::Marks, ListKind::Control] }
}

fn is_mark(row: &Row) -> bool {
    let number = |field: &String| field.parse::<f64>().is_ok_and(f64::is_finite);
    let fields = &row.fields;
    (4..=6).contains(&fields.len()) && !fields[0].is_empty() && !fields[1].is_empty() && fields[2..].iter().all(number)
}

impl Desk {
    /// Takes text files: each goes where its content belongs. `quietly`: they came with photos, and wait at their steps.
    pub fn take_texts(self, files: Vec<NamedFile>, quietly: bool) {
        if files.is_empty() {
            return;
        }
        spawn_local(async move {
            let Some(all) = self.contents(files).await else { return };
            if comparator::recognises(&all) {
                return self.take_plates(&all);
            }
            self.sort_texts(all, quietly);
        });
    }

    fn sort_texts(self, files: Files, quietly: bool) {
        let here = self.step.get_untracked();
        let mut waiting = Vec::new();
        let mut refused = Vec::new();
        for (name, bytes) in files {
            let content = match encoding::list(&bytes, None) {
                Ok((content, ..)) => content,
                Err(error) => {
                    refused.push(Problem { file: name, reason: Reason::Engine(error) });
                    continue;
                }
            };
            let found = self.document.with_untracked(|d| readings(&content, &d.project));
            match (found.as_slice(), here) {
                ([], _) => refused.push(Problem { file: name, reason: Reason::NoList }),
                ([one], _) => waiting.push((name, bytes, content, *one)),
                // The open step decides which of the two is meant.
                (_, Step::Identities) => waiting.push((name, bytes, content, ListKind::Marks)),
                (_, Step::Control) => waiting.push((name, bytes, content, ListKind::Control)),
                _ => self.ask_which(name, bytes, content),
            }
        }
        let mut told = Vec::new();
        let mut next = VecDeque::new();
        let mut shown = false;
        for (name, bytes, content, reading) in waiting {
            if shown && reading != ListKind::Marks {
                next.push_back(NextList { name, bytes, content, kind: reading });
                continue;
            }
            let ready = match reading {
                ListKind::Marks => self.read_marks(name.clone(), &content),
                ListKind::Control => self.read_control_file(name.clone(), bytes),
                ListKind::Distances => self.read_distances(name.clone(), content),
            };
            shown |= ready && reading != ListKind::Marks;
            if ready {
                told.push((name, reading));
            }
        }
        let names = name_list(next.iter().map(|list| &list.name));
        let any = !next.is_empty();
        self.intake.next_lists.update(|lists| lists.extend(next));
        if !refused.is_empty() {
            self.tell_problems(refused);
        }
        // A list of points is answered where it was dropped.
        if let Some((_, ListKind::Marks)) = told.first().filter(|_| !quietly) {
            self.go(Step::Identities);
        }
        let alone = told.len() <= usize::from(!quietly);
        if any || !alone {
            self.say(false, Until::NextWork, move || {
                let words = told.iter().filter(|_| !alone).map(|(name, reading)| match reading {
                    ListKind::Marks => text::waits_at_identities(name),
                    ListKind::Control | ListKind::Distances => text::waits_at_control(name),
                });
                words.chain(any.then(|| lists_words::next_lists(&names))).collect::<Vec<_>>().join(" ")
            });
        }
    }

    /// Shows the next list of the same drop, if no other is shown.
    pub fn show_next_list(self) {
        if self.intake.pasted.with(Option::is_some) || self.intake.distances.with(Option::is_some) {
            return;
        }
        let next = self.intake.next_lists.with(|lists| lists.front().cloned());
        let Some(NextList { name, bytes, content, kind }) = next else { return };
        self.intake.next_lists.update(|lists| _ = lists.pop_front());
        untrack(|| match kind {
            ListKind::Distances => self.read_distances(name, content),
            _ => self.read_control_file(name, bytes),
        });
    }

    /// Asks what a text is that could be marks or control points.
    fn ask_which(self, name: String, bytes: Vec<u8>, content: String) {
        let (bytes, content) = (Rc::new(bytes), Rc::new(content));
        let choice = |words: crate::i18n::Text, reading: ListKind| {
            let (name, bytes, content) = (name.clone(), bytes.clone(), content.clone());
            let take: Rc<dyn Fn()> = Rc::new(move || {
                let ready = match reading {
                    ListKind::Marks => self.read_marks(name.clone(), &content),
                    ListKind::Control => self.read_control_file(name.clone(), bytes.to_vec()),
                    ListKind::Distances => self.read_distances(name.clone(), content.to_string()),
                };
                if ready && reading == ListKind::Marks {
                    self.go(reading.step());
                }
            });
            (words, take)
        };
        let choices = vec![choice(text::marks, ListKind::Marks), choice(text::control_points, ListKind::Control)];
        let name = name.clone();
        self.messages.asking.set(Some(Asking { text: Rc::new(move || text::marks_or_control(&name)), choices }));
    }

    /// Reads a text file that is known to be of a kind, and goes where it is examined.
    pub fn read_text(self, file: NamedFile, reading: ListKind) {
        spawn_local(async move {
            let name = file.name.clone();
            let Some(mut all) = self.contents(vec![file]).await else { return };
            let bytes = all.remove(&name).unwrap_or_default();
            match encoding::list(&bytes, None) {
                Ok((content, ..)) => {
                    let ready = match reading {
                        ListKind::Marks => self.read_marks(name, &content),
                        ListKind::Control => self.read_control_file(name, bytes),
                        ListKind::Distances => self.read_distances(name.clone(), content.to_string()),
                    };
                    if ready {
                        self.go(reading.step());
                    }
                }
                Err(error) => self.warn_error(error.in_file(&name)),
            }
        });
    }

    /// Names and contents; none, with a message, if the browser cannot read a file.
    pub(super) async fn contents(self, files: Vec<NamedFile>) -> Option<Files> {
        let mut all = Files::new();
        for file in files {
            match file.content.read().await {
                Ok(bytes) => all.insert(file.name, bytes),
                Err(detail) => {
                    self.say(true, Until::NextWork, move || text::unreadable(&detail));
                    return None;
                }
            };
        }
        Some(all)
    }
}

impl ListKind {
    /// The step that such a text belongs to.
    fn step(self) -> Step {
        match self {
            Self::Marks => Step::Identities,
            Self::Control | Self::Distances => Step::Control,
        }
    }
}

#[cfg(test)]
mod tests {
    use sightline::project::Photo;

    use super::*;

    fn project() -> Project {
        let photo = |id: &str| Photo { id: id.into(), file: format!("P{id}.jpg"), ..Photo::default() };
        Project { photos: vec![photo("1"), photo("2"), photo("3")].into(), ..Project::default() }
    }

    #[test]
    fn marks_and_control_are_told_apart_by_what_is_in_them() {
        let p = project();
        assert_eq!(readings("1,1,848.1,514.9,0.1\n1,2,917.7,520.0,0.1\n2,1,9.0,8.0,0.1\n", &p), [ListKind::Marks]);
        assert_eq!(readings("1001 0 1 0\n1002 1 1 0\n1003 0 0 0\n", &p), [ListKind::Control]);
        assert_eq!(readings("id;X [m];Y [m];Z [m]\nA;1,5;2,5;3,5\nB;1,0;2,0;3,0\n", &p), [ListKind::Control]);
        assert_eq!(readings("point\tX\tY\tZ\tsigma\n1\t1.5\t2.5\t3.5\t0.01\n", &p), [ListKind::Control]);
        assert_eq!(readings("# a comment\n\nCP1 control 1.0 2.0 3.0\n", &p), [ListKind::Control]);
    }

    #[test]
    fn lists_that_leave_something_open_are_lists() {
        let p = project();
        // To be refused with the reason or asked where they are shown, not told to be no list.
        for open in [
            "P1,1,234,2,345,3,456\nP2,4,567,5,678,6,789\n",
            "1,5000.123,3000.456,101.231,TGT\n2,5004.223,3001.112,101.901,TGT\n",
            "P1\t1,234\t2,345\t3,456\n",
            "#Label,X/Easting,Y/Northing,Z/Altitude,Error_(m)\nt1,0.0,0.0,0.0,0.002\n",
            "id,X [banana],Y,Z\n1,1.5,2.5,3.5\n",
        ] {
            assert_eq!(readings(open, &p), [ListKind::Control], "{open}");
        }
    }

    #[test]
    fn names_in_tables_hold_blanks_and_separators() {
        let p = project();
        assert_eq!(readings("1,\"5,6\",848.1,514.9\n1,\"5,7\",917.7,520.0\n", &p), [ListKind::Marks]);
        assert_eq!(readings("1\tP 1\t848.1\t514.9\n1\tP 2\t917.7\t520.0\t\n", &p), [ListKind::Marks]);
        assert_eq!(readings("\"X 1\";1,5;2,5;3,5\n\"X 2\";1,0;2,0;3,0\n", &p), [ListKind::Control]);
        assert_eq!(
            readings("\"id\"\t\"X [m]\"\t\"Y [m]\"\t\"Z [m]\"\nP 1\t1\t2\t3\nP 2\t1\t2\t4\n", &p),
            [ListKind::Control]
        );
        // A photo without a name is no mark.
        assert!(!readings("\t5\t848.1\t514.9\n\t6\t917.7\t520.0\n", &p).contains(&ListKind::Marks));
    }

    #[test]
    fn what_can_be_both_is_both_and_prose_is_neither() {
        assert_eq!(readings("1 7 100.5 200.5\n2 7 101.5 201.5\n", &project()), [ListKind::Marks, ListKind::Control]);
        assert_eq!(readings("1 7 100.5 200.5\n2 7 101.5 201.5\n", &Project::default()).len(), 2);
        assert_eq!(readings("1 7.25 100.5 200.5\n2 7.5 101.5 201.5\n", &project()), [ListKind::Control]);
        assert!(
            readings("Dear Sir or Madam,\n\nplease find enclosed 8 photos of 24 targets.\n", &project()).is_empty()
        );
        assert!(readings("", &project()).is_empty());
    }
}
