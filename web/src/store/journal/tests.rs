//! Tests of what the storage keeps of a project.

use super::*;
use crate::edit::undoing::{self, ACTIONS, bytes};

/// A journal as the storage has it.
#[derive(Default)]
pub struct Journal {
    pub notes: Vec<String>,
    pub texts: HashMap<u64, String>,
    pub kinds: HashMap<u64, String>,
}

impl Journal {
    pub fn add(&mut self, added: Option<(Note, Vec<JournalPart>)>) {
        let Some((note, parts)) = added else { return };
        self.notes.push(to_text(&note));
        self.kinds.extend(parts.iter().map(|part| (part.number, part.kind.clone())));
        self.texts.extend(parts.into_iter().map(|part| (part.number, joined(part.text))));
    }

    /// Asks for parts as the page does, a few at a time.
    fn document(&self, book: &mut Book, state: &JournalState) -> Document {
        let mut texts = HashMap::new();
        loop {
            let wanted = book.wanted(state, &texts).unwrap();
            if wanted.is_empty() {
                return book.document(state, &texts).unwrap();
            }
            texts.extend(wanted.into_iter().map(|number| (number, self.texts[&number].clone())));
        }
    }

    pub fn read(&self) -> (Document, History, Book) {
        let replayed = replay(&self.notes).unwrap();
        let changes = |stack: &[(Change, JournalState)]| stack.iter().map(|(change, _)| change.clone()).collect();
        let mut history = History::stored(changes(&replayed.past), changes(&replayed.future));
        let next = self.texts.keys().max().unwrap() + 1;
        let mut book = Book::of(&replayed, &history, next);
        let document = self.document(&mut book, replayed.present.as_ref().unwrap());
        book.go_on_from(&document);
        let states = replayed.past.iter().chain(&replayed.future);
        let serials = history.past.iter().chain(&history.future).map(|entry| entry.serial).collect::<Vec<_>>();
        for ((_, state), serial) in states.zip(serials) {
            history.fill(serial, self.document(&mut book, state));
        }
        (document, history, book)
    }
}

fn joined(text: Vec<Piece>) -> String {
    let words = |piece| match piece {
        Piece::Text(text) => text,
        Piece::Bytes(_) => panic!("there are none outside browsers"),
    };
    text.into_iter().map(words).collect()
}

pub fn renamed(document: &Document, name: &str) -> Document {
    let mut document = document.clone();
    document.project_mut().name = name.into();
    document
}

#[test]
fn a_journal_gives_back_the_state_and_the_history_after_every_note() {
    let (mut book, mut journal, mut history) = (Book::default(), Journal::default(), History::default());
    let files = BTreeMap::new();
    let mut document = renamed(&Document::default(), "0");
    journal.add(book.note(&document, &history, &files));
    for step in 1..40 {
        match step % 7 {
            4 | 6 => document = history.undo(document).unwrap(),
            5 => document = history.redo(document).unwrap(),
            _ => {
                history.push(Change::UnitSet, document.clone());
                document = renamed(&document, &step.to_string());
            }
        }
        journal.add(book.note(&document, &history, &files));
        let (read, past, _) = journal.read();
        assert_eq!(read.project.name, document.project.name, "{step}");
        let names = |history: &History| {
            let name = |document: Option<Document>| document.unwrap().project.name.clone();
            let [past, future] =
                [&history.past, &history.future].map(|s| documents(s, 0).into_iter().map(name).collect::<Vec<_>>());
            (past, future)
        };
        assert_eq!(names(&past), names(&history), "{step}");
    }
    assert!(book.note(&document, &history, &files).is_none());
}

#[test]
fn what_was_read_is_not_written_again() {
    let (mut book, mut journal, mut history) = (Book::default(), Journal::default(), History::default());
    let mut document = renamed(&Document::default(), "a");
    let adjustment = from_text(
        r#"{"termination":"converged","iterations":[],"observations_count":0,"unknowns":0,"constraints":0,
            "redundancy":0,"sigma0":null,"global_test":null,"cameras":[],"photos":[],"points":[],"observations":[],
            "check_points":[],"precision":null}"#,
    );
    let input = document.project.clone();
    let outcome = AdjustmentResult { oriented: input.clone(), input, adjustment: adjustment.unwrap() };
    history.push(Change::Adjusted, document.clone());
    document.result = Some(Arc::new(outcome));
    journal.add(book.note(&document, &history, &BTreeMap::new()));
    let (read, past, mut book) = journal.read();
    // The result still belongs to the project.
    assert!(read.current().is_some());
    book.files(9, "{}").unwrap();
    assert!(book.note(&read, &past, &BTreeMap::new()).is_none());
    let changed = renamed(&read, "b");
    let (_, parts) = book.note(&changed, &past, &BTreeMap::new()).unwrap();
    assert_eq!(parts.iter().map(|part| part.kind.as_str()).collect::<Vec<_>>(), ["head"]);
}

#[test]
fn a_result_is_written_as_it_came() {
    let (mut book, mut journal) = (Book::default(), Journal::default());
    let outcome = |sigma0| {
        let input = Arc::new(Project::default());
        let row = |k| AdjustedPoint { id: format!("{k}"), xyz: [0.1, k as f64 / 3.0, -0.0], ..Default::default() };
        let points = (0..2500).map(row).collect();
        let adjustment = Adjustment { sigma0: Some(sigma0), points, ..Adjustment::default() };
        Arc::new(AdjustmentResult { oriented: Arc::new(Project::clone(&input)), input, adjustment })
    };
    let text = |text: &str| Piece::Text(text.into());
    let (first, second) = (outcome(0.5), outcome(1.5));
    let mut document = renamed(&Document::default(), "a");
    document.result = Some(first.clone());
    let pieces = sightline_protocol::written(&first.adjustment);
    let pieces = pieces.map(|(piece, bytes)| (piece, text(&(String::from_utf8(bytes).unwrap() + " "))));
    book.came(&first, pieces.collect());
    journal.add(book.note(&document, &History::default(), &BTreeMap::new()));
    assert_eq!(journal.texts.values().filter(|text| text.contains("} ,")).count(), 1);
    assert_eq!(journal.read().0.result, Some(first));
    // The texts of one result are not those of another.
    book.came(&outcome(2.5), Vec::new());
    document.result = Some(second.clone());
    journal.add(book.note(&document, &History::default(), &BTreeMap::new()));
    assert_eq!(journal.read().0.result, Some(second));
}

#[test]
fn a_name_given_from_outside_holds_until_the_next_state() {
    let (mut book, mut journal) = (Book::default(), Journal::default());
    let document = renamed(&Document::default(), "a");
    journal.add(book.note(&document, &History::default(), &BTreeMap::new()));
    journal.notes.push(r#"{"name":"b"}"#.into());
    assert_eq!(replay(&journal.notes).unwrap().name.as_deref(), Some("b"));
    journal.add(book.note(&renamed(&document, "c"), &History::default(), &BTreeMap::new()));
    assert_eq!(replay(&journal.notes).unwrap().name, None);
}

/// A stack's documents and the present one, as bytes.
fn contents(document: &Document, history: &History) -> Vec<Vec<Option<[String; 5]>>> {
    let of = |stack: &[HistoryEntry]| documents(stack, 0).iter().map(|d| d.as_ref().map(bytes)).collect();
    vec![of(&history.past), vec![Some(bytes(document))], of(&history.future)]
}

#[test]
fn any_row_of_actions_is_read_from_the_journal_as_it_was_made() {
    for seed in 1_u64..25 {
        let mut state = seed;
        let mut random = |n: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as usize % n
        };
        let (mut book, mut journal, mut history) = (Book::default(), Journal::default(), History::default());
        let files = BTreeMap::new();
        let mut document = undoing::document();
        for step in 0..60 {
            // Several edits may come before they are written.
            for _ in 0..1 + random(3) {
                match random(8) {
                    0 | 1 => document = history.undo(document.clone()).unwrap_or(document),
                    2 => document = history.redo(document.clone()).unwrap_or(document),
                    _ => {
                        history.push(Change::UnitSet, document.clone());
                        ACTIONS[random(ACTIONS.len())].1(&mut document);
                    }
                }
            }
            journal.add(book.note(&document, &history, &files));
            if random(6) == 0 {
                let (read, past, new) = journal.read();
                assert_eq!(contents(&read, &past), contents(&document, &history), "seed {seed}, step {step}");
                // Sometimes the page is opened again, and goes on from what it read.
                if random(2) == 0 {
                    (document, history, book) = (read, past, new);
                    book.files(u64::MAX, "{}").unwrap();
                }
            }
        }
    }
}

/// An edit of a large network writes what it changes.
#[test]
fn an_edit_of_a_large_network_writes_little() {
    let mut project = Project::default();
    let row = |k: usize| sightline::project::Observation {
        photo: format!("photo {}", k % 100),
        point: format!("point {}", k / 100),
        u: k as f64 / 7.0,
        v: 0.0,
        sigma: sightline::project::Sigma::One(0.1),
        enabled: true,
        target: None,
    };
    project.observations = (0..2200).map(row).collect();
    let mut document = Document { project: Arc::new(project), ..Document::default() };
    let (mut book, mut history) = (Book::default(), History::default());
    let files = BTreeMap::new();
    book.note(&document, &history, &files);
    let mut whole_ones = 0;
    for k in 0..300 {
        history.push(Change::UnitSet, document.clone());
        document.project_mut().observations[k * 7].enabled = false;
        let (note, parts) = book.note(&document, &history, &files).unwrap();
        let written = to_text(&note).len() + parts.iter().map(|part| joined(part.text.clone()).len()).sum::<usize>();
        let whole = parts.iter().any(|part| part.kind == "observations");
        whole_ones += usize::from(whole);
        assert!(whole || written < 4096, "{written} characters at edit {k}");
    }
    assert_eq!(whole_ones, 1);
    // A change of the datum writes no table.
    history.push(Change::DatumChosen, document.clone());
    document.project_mut().datum = sightline::project::Datum::default();
    let (_, parts) = book.note(&document, &history, &files).unwrap_or_default();
    assert!(parts.iter().all(|part| part.kind == "head"));
}

/// Before tables were parts of their own a project's part was its whole text, and a result's had its whole adjustment.
#[test]
fn a_journal_of_before_is_read_and_goes_on() {
    let document = undoing::document();
    let state = |project| {
        format!(
            r#"{{"project":{project},"detections":1,"doubtful":2,"result":5,"options":{},"sigmas_of_held":[]}}"#,
            to_text(&document.options)
        )
    };
    let note = format!(
        r#"{{"past":{{"keep":0,"add":[["UnitSet",{}]]}},"future":{{"keep":0,"add":[]}},"present":{},"files":6}}"#,
        state(3),
        state(4)
    );
    let adjustment = to_text(&Adjustment { sigma0: Some(1.25), ..Adjustment::default() });
    let texts = [
        (1, "{}".into()),
        (2, "[]".into()),
        (3, to_text(&*renamed(&document, "before").project)),
        (4, to_text(&*renamed(&document, "now").project)),
        (5, format!(r#"{{"input":3,"oriented":3,"adjustment":{adjustment}}}"#)),
        (6, "{}".into()),
    ];
    let mut journal = Journal { notes: vec![note], texts: HashMap::from(texts), ..Journal::default() };
    let (mut read, mut history, mut book) = journal.read();
    book.files(6, "{}").unwrap();
    assert_eq!(read.project, renamed(&document, "now").project);
    assert_eq!(read.result.as_ref().map(|result| result.adjustment.sigma0), Some(Some(1.25)));
    assert_eq!(documents(&history.past, 0)[0].as_ref().map(|d| d.project.name.as_str()), Some("before"));
    for (_, action) in ACTIONS {
        history.push(Change::UnitSet, read.clone());
        action(&mut read);
        journal.add(book.note(&read, &history, &BTreeMap::new()));
    }
    let (again, past, _) = journal.read();
    assert_eq!(contents(&again, &past), contents(&read, &history));
}

/// A journal of a version that corrected lateral colour: the project opens, its origin names what is not kept, and a result that was computed
/// with it is not the project's.
#[test]
fn a_journal_with_lateral_colour_is_read_without_it() {
    let mut document = undoing::document();
    let input = document.project.clone();
    let camera = sightline::adjustment::AdjustedCamera {
        camera: input.cameras[0].clone(),
        photo: None,
        sigma: BTreeMap::new(),
        significance: BTreeMap::new(),
        correlation: sightline::adjustment::Correlation::default(),
    };
    let adjustment = Adjustment { cameras: vec![camera], ..Adjustment::default() };
    document.result = Some(Arc::new(AdjustmentResult { oriented: input.clone(), input, adjustment }));
    let mut journal = Journal::default();
    journal.add(Book::default().note(&document, &History::default(), &BTreeMap::new()));
    let (read, ..) = journal.read();
    assert_eq!((read.project.origin.as_ref(), read.result.is_some()), (None, true));

    let set = r#""colours":{"red":{"parameters":{"k1":1e-7}}},"free":"#;
    for (number, text) in &mut journal.texts {
        match journal.kinds[number].as_str() {
            "photos" => *text = text.replacen(r#","enabled":"#, r#","colour":"red","enabled":"#, 2),
            "head" => *text = text.replacen(r#""free":"#, set, 1),
            "result" => *text = text.replacen(r#""free":"#, set, 1),
            _ => {}
        }
    }
    let (read, ..) = journal.read();
    let origin = read.project.origin.as_deref().expect("an origin");
    let named: Vec<_> = origin.ignored.iter().map(|one| (one.name.as_str(), one.count)).collect();
    assert_eq!(named, [(RemovedFields::OF_CAMERAS, 1), (RemovedFields::OF_PHOTOS, 2)]);
    assert!(read.result.is_none());
    assert_eq!(read.project.photos, document.project.photos);

    // Stored and read again, it is listed only once.
    let mut journal = Journal::default();
    journal.add(Book::default().note(&read, &History::default(), &BTreeMap::new()));
    assert_eq!(journal.read().0.project, read.project);
}
