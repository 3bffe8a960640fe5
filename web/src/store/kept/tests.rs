//! Tests of what the storage keeps of a project.

use super::*;

/// A journal as the storage has it.
#[derive(Default)]
pub struct Journal {
    pub notes: Vec<String>,
    pub texts: HashMap<u64, String>,
    pub kinds: HashMap<u64, String>,
}

impl Journal {
    pub fn add(&mut self, added: Option<(Note, Vec<Part>)>) {
        let Some((note, parts)) = added else { return };
        self.notes.push(to_text(&note));
        self.kinds.extend(parts.iter().map(|part| (part.number, part.kind.clone())));
        self.texts.extend(parts.into_iter().map(|part| (part.number, joined(part.text))));
    }

    pub fn read(&self) -> (Document, History, Book) {
        let replayed = replay(&self.notes).unwrap();
        let changes = |stack: &[(Change, State)]| stack.iter().map(|(change, _)| change.clone()).collect();
        let mut history = History::stored(changes(&replayed.past), changes(&replayed.future));
        let next = self.texts.keys().max().unwrap() + 1;
        let mut book = Book::of(&replayed, &history, next);
        let document = book.document(replayed.present.as_ref().unwrap(), &self.texts).unwrap();
        let states = replayed.past.iter().chain(&replayed.future);
        let serials = history.past.iter().chain(&history.future).map(|entry| entry.serial).collect::<Vec<_>>();
        for ((_, state), serial) in states.zip(serials) {
            history.fill(serial, book.document(state, &self.texts).unwrap());
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
            let name = |entry: &super::super::document::Entry| entry.state.clone().unwrap().project.name.clone();
            let [past, future] = [&history.past, &history.future].map(|s| s.iter().map(name).collect::<Vec<_>>());
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
    let outcome = Outcome { oriented: input.clone(), input, adjustment: adjustment.unwrap() };
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
    assert_eq!(parts.iter().map(|part| part.kind.as_str()).collect::<Vec<_>>(), ["project"]);
}

#[test]
fn a_result_is_written_as_it_came() {
    let (mut book, mut journal) = (Book::default(), Journal::default());
    let outcome = |sigma0| {
        let input = Arc::new(Project::default());
        let adjustment = Adjustment { sigma0: Some(sigma0), ..Adjustment::default() };
        Arc::new(Outcome { oriented: Arc::new(Project::clone(&input)), input, adjustment })
    };
    let text = |text: &str| Piece::Text(text.into());
    let (first, second) = (outcome(0.5), outcome(1.5));
    let mut document = renamed(&Document::default(), "a");
    document.result = Some(first.clone());
    let [oriented, adjustment] = [to_text(&*first.oriented), to_text(&first.adjustment)];
    let (start, end) = adjustment.split_at(1);
    book.came(&first, [vec![text(&oriented), text(" ")], vec![text(start), text(" "), text(end)]]);
    journal.add(book.note(&document, &History::default(), &BTreeMap::new()));
    assert_eq!(journal.texts.values().filter(|text| text.contains("{ ") || text.ends_with("} ")).count(), 2);
    assert_eq!(journal.read().0.result, Some(first));
    // The texts of one result are not those of another.
    book.came(&outcome(2.5), [vec![text("")], vec![text("")]]);
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
