//! A pool of workers: a queue of tasks, one at a time in each worker; cancelling ends the worker and a new one replaces it.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;

use crate::browser::file::Blob;
use crate::browser::page;
use crate::browser::worker::{Bytes, Message, Worker};
use crate::protocol::{Answer, Request};

/// What becomes of a task.
pub enum Outcome {
    /// The engine's answer (progress or end) with its bytes.
    Answer(Answer, Vec<Bytes>),
    /// The worker was lost; its words.
    Crashed(String),
}

/// Tasks that are cancelled together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch(usize);

struct Task {
    batch: Batch,
    request: Request,
    files: Vec<Blob>,
    on_outcome: Rc<RefCell<dyn FnMut(Outcome)>>,
}

struct Slot {
    worker: Worker,
    ready: bool,
    task: Option<Task>,
}

#[derive(Default)]
struct Inner {
    queue: VecDeque<Task>,
    slots: BTreeMap<usize, Slot>,
    next: usize,
}

/// Handle of the pool.
#[derive(Clone, Default)]
pub struct Pool(Rc<RefCell<Inner>>);

impl Pool {
    /// A name for tasks that belong together.
    pub fn batch(&self) -> Batch {
        let mut inner = self.0.borrow_mut();
        inner.next += 1;
        Batch(inner.next)
    }

    /// Queues a task.
    pub fn submit(&self, batch: Batch, request: Request, files: Vec<Blob>, on_outcome: impl FnMut(Outcome) + 'static) {
        let task = Task { batch, request, files, on_outcome: Rc::new(RefCell::new(on_outcome)) };
        self.0.borrow_mut().queue.push_back(task);
        self.pump();
    }

    /// Puts a task before all others: somebody waits for it with the pointer in hand.
    pub fn submit_first(&self, request: Request, files: Vec<Blob>, on_outcome: impl FnMut(Outcome) + 'static) -> Batch {
        let batch = self.batch();
        let task = Task { batch, request, files, on_outcome: Rc::new(RefCell::new(on_outcome)) };
        self.0.borrow_mut().queue.push_front(task);
        self.pump();
        batch
    }

    /// Ends everything of a batch at once; nothing more is heard of it.
    pub fn cancel(&self, batch: Batch) {
        let ended = {
            let mut inner = self.0.borrow_mut();
            inner.queue.retain(|task| task.batch != batch);
            let busy = |slot: &Slot| slot.task.as_ref().is_some_and(|task| task.batch == batch);
            let ids = inner.slots.iter().filter(|(_, slot)| busy(slot)).map(|(&id, _)| id).collect::<Vec<_>>();
            ids.into_iter().filter_map(|id| inner.slots.remove(&id)).collect::<Vec<_>>()
        };
        discard(ended);
        self.pump();
    }

    /// Hands queued tasks to workers that are free, and starts workers while there are too few.
    fn pump(&self) {
        let mut failures = Vec::new();
        loop {
            let mut inner = self.0.borrow_mut();
            if inner.queue.is_empty() {
                break;
            }
            let free = inner.slots.iter().find(|(_, slot)| slot.ready && slot.task.is_none()).map(|(&id, _)| id);
            if let Some(id) = free {
                let Some(task) = inner.queue.pop_front() else { break };
                let Some(slot) = inner.slots.get_mut(&id) else { break };
                match slot.worker.post(&task.request, &task.files) {
                    Ok(()) => slot.task = Some(task),
                    Err(detail) => failures.push((task, detail)),
                }
                continue;
            }
            let starting = inner.slots.values().filter(|slot| !slot.ready).count();
            if inner.slots.len() >= page::worker_count() || starting >= inner.queue.len() {
                break;
            }
            inner.next += 1;
            let id = inner.next;
            drop(inner);
            let pool = self.clone();
            match Worker::start(move |message| pool.hear(id, message)) {
                Ok(worker) => {
                    let slot = Slot { worker, ready: false, task: None };
                    self.0.borrow_mut().slots.insert(id, slot);
                }
                Err(detail) => {
                    let Some(task) = self.0.borrow_mut().queue.pop_front() else { break };
                    failures.push((task, detail));
                }
            }
        }
        for (task, detail) in failures {
            (task.on_outcome.borrow_mut())(Outcome::Crashed(detail));
        }
    }

    fn hear(&self, id: usize, message: Message) {
        match message {
            Message::Ready => {
                if let Some(slot) = self.0.borrow_mut().slots.get_mut(&id) {
                    slot.ready = true;
                }
            }
            Message::Answer(answer, bytes) => {
                let listener = {
                    let mut inner = self.0.borrow_mut();
                    let Some(slot) = inner.slots.get_mut(&id) else { return };
                    let listener = slot.task.as_ref().map(|task| task.on_outcome.clone());
                    if !answer.is_progress() {
                        slot.task = None;
                    }
                    listener
                };
                if let Some(listener) = listener {
                    (listener.borrow_mut())(Outcome::Answer(answer, bytes));
                }
            }
            Message::Crashed(detail) => {
                let Some(mut slot) = self.0.borrow_mut().slots.remove(&id) else { return };
                let task = slot.task.take();
                // A worker that cannot even start would be started again and again.
                let waiting = if slot.ready { None } else { self.0.borrow_mut().queue.pop_front() };
                discard(vec![slot]);
                for task in task.into_iter().chain(waiting) {
                    (task.on_outcome.borrow_mut())(Outcome::Crashed(detail.clone()));
                }
            }
        }
        self.pump();
        self.shrink();
    }

    /// A worker's memory only grows: when nothing is left to do, one fresh enough worker stays.
    fn shrink(&self) {
        let ended = {
            let mut inner = self.0.borrow_mut();
            if !inner.queue.is_empty() || inner.slots.values().any(|slot| slot.task.is_some()) {
                return;
            }
            let ids = inner.slots.keys().skip(1).copied().collect::<Vec<_>>();
            ids.into_iter().filter_map(|id| inner.slots.remove(&id)).collect::<Vec<_>>()
        };
        discard(ended);
    }
}

/// Ends workers now, but frees their listeners later: one of them may be the caller.
fn discard(slots: Vec<Slot>) {
    for slot in &slots {
        slot.worker.terminate();
    }
    page::after(0, move || drop(slots));
}
