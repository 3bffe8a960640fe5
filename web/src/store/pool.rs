//! A pool of workers: a queue of tasks, one at a time in each worker; cancelling ends the worker and a new one replaces it.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};
use std::rc::Rc;

use sightline::Error;
use sightline_protocol::{Request, Said, SaidTo, Task, from_bytes};

use crate::browser::file::Blob;
use crate::browser::page;
use crate::browser::worker::{Bytes, Message, Worker};

/// Message of a worker about a task. Every message except progress ends the task.
pub enum TaskOutcome<T: Task> {
    /// It goes on.
    Progress(T::Progress),
    /// It is done; the bytes belong to the answer.
    Done(T::Answer, Vec<Bytes>),
    /// It gave nothing.
    Failed(Failure),
}

/// Why a task gave nothing.
pub enum Failure {
    /// The engine refused.
    Refused(Error),
    /// A file could not be read; the browser's words.
    Unreadable(String),
    /// The worker was lost, or sent an invalid answer.
    Lost(String),
}

/// Message of a worker about a task, not yet decoded.
enum Heard {
    Said(Vec<u8>, Vec<Bytes>),
    Lost(String),
}

/// The decoded message: whether it ends the task, and the callback for it.
struct Understood {
    ends: bool,
    tell: Box<dyn FnOnce()>,
}

/// Decodes a message to a task.
type Listener = Rc<dyn Fn(Heard) -> Understood>;

/// Of a photo whose size is not known yet.
const USUAL_PIXELS: f64 = 24e6;

/// A worker whose engine has grown beyond this, in bytes, with a document or a picture for the screen is not kept for what comes next: its
/// memory never shrinks. To measure a photo of usual size takes less, and what takes so much takes longer than a worker to start.
const GROWN: f64 = 192e6;

/// An answer of more bytes is understood in one task of the page and told in the next: what is made of it takes as long as reading it.
const LONG: usize = 1 << 18;

/// Tasks that are cancelled together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch(usize);

struct QueuedTask {
    batch: Batch,
    request: Request,
    files: Vec<Blob>,
    listener: Listener,
    /// Whether a worker was lost with it already.
    tried: bool,
}

struct Slot {
    worker: Worker,
    ready: bool,
    task: Option<QueuedTask>,
    /// Bytes that its engine had taken when its last task ended.
    taken: f64,
}

impl QueuedTask {
    /// Whether it takes what no other photo takes.
    fn is_apart(&self) -> bool {
        self.files.is_empty() || self.request.is_apart()
    }
}

struct Inner {
    queue: VecDeque<QueuedTask>,
    slots: BTreeMap<usize, Slot>,
    next: usize,
    /// Of the largest photo.
    pixels: f64,
    /// The most that a worker's engine has taken with such photos, in bytes.
    taken: f64,
    /// Workers at once: fewer when one was lost, for memory is the likely reason.
    most: usize,
    /// Of these an answer is understood and not told yet.
    untold: Vec<Batch>,
}

impl Default for Inner {
    fn default() -> Self {
        Self {
            queue: VecDeque::new(),
            slots: BTreeMap::new(),
            next: 0,
            pixels: USUAL_PIXELS,
            taken: 0.0,
            most: usize::MAX,
            untold: Vec::new(),
        }
    }
}

impl Inner {
    /// Workers at once.
    fn room(&self) -> usize {
        page::worker_count(self.pixels, self.taken).min(self.most)
    }
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
    pub fn submit<T: Task + Into<Request>>(
        &self,
        batch: Batch,
        task: T,
        files: Vec<Blob>,
        on_outcome: impl FnMut(TaskOutcome<T>) + 'static,
    ) {
        self.0.borrow_mut().queue.push_back(job(batch, task, files, on_outcome));
        self.pump();
    }

    /// Puts a task before all others, for interactive requests.
    pub fn submit_first<T: Task + Into<Request>>(
        &self,
        task: T,
        files: Vec<Blob>,
        on_outcome: impl FnMut(TaskOutcome<T>) + 'static,
    ) -> Batch {
        let batch = self.batch();
        self.0.borrow_mut().queue.push_front(job(batch, task, files, on_outcome));
        self.pump();
        batch
    }

    /// Takes note of the largest photo: the number of workers follows it.
    pub fn expect_pixels(&self, pixels: f64) {
        let mut inner = self.0.borrow_mut();
        if inner.pixels != pixels {
            (inner.pixels, inner.taken) = (pixels, 0.0);
        }
    }

    /// Cancels all tasks of a batch at once, without further messages.
    pub fn cancel(&self, batch: Batch) {
        let ended = {
            let mut inner = self.0.borrow_mut();
            inner.queue.retain(|task| task.batch != batch);
            inner.untold.retain(|untold| *untold != batch);
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
            if inner.slots.len() >= inner.room() || starting >= inner.queue.len() {
                break;
            }
            inner.next += 1;
            let id = inner.next;
            drop(inner);
            let pool = self.clone();
            match Worker::start(move |message| pool.hear(id, message)) {
                Ok(worker) => {
                    let slot = Slot { worker, ready: false, task: None, taken: 0.0 };
                    self.0.borrow_mut().slots.insert(id, slot);
                }
                Err(detail) => {
                    let Some(task) = self.0.borrow_mut().queue.pop_front() else { break };
                    failures.push((task, detail));
                }
            }
        }
        for (task, detail) in failures {
            ((task.listener)(Heard::Lost(detail)).tell)();
        }
    }

    fn hear(&self, id: usize, message: Message) {
        match message {
            Message::Ready => {
                if let Some(slot) = self.0.borrow_mut().slots.get_mut(&id) {
                    slot.ready = true;
                }
            }
            Message::Said(body, bytes, taken) => {
                let task = {
                    let inner = self.0.borrow();
                    let task = inner.slots.get(&id).and_then(|slot| slot.task.as_ref());
                    task.map(|task| (task.listener.clone(), task.batch))
                };
                let Some((listener, batch)) = task else { return };
                let long = body.len() > LONG;
                let understood = listener(Heard::Said(body, bytes));
                // Freed before the callback, which may submit the next task.
                self.free(id, taken, understood.ends);
                // Progress messages are delivered at once, so that they never follow the end of the task.
                if long && understood.ends {
                    self.tell_soon(batch, understood.tell);
                } else {
                    (understood.tell)();
                }
            }
            Message::Crashed(detail) => {
                let Some(mut slot) = self.0.borrow_mut().slots.remove(&id) else { return };
                let mut task = slot.task.take();
                // A worker that cannot even start would be started again and again.
                let waiting = if slot.ready { None } else { self.0.borrow_mut().queue.pop_front() };
                discard(vec![slot]);
                if let Some(again) = task.take_if(|task| !task.tried) {
                    let mut inner = self.0.borrow_mut();
                    inner.most = (inner.slots.len() + 1).div_ceil(2);
                    inner.queue.push_front(QueuedTask { tried: true, ..again });
                }
                for task in task.into_iter().chain(waiting) {
                    ((task.listener)(Heard::Lost(detail.clone())).tell)();
                }
            }
        }
        self.pump();
        self.shrink();
    }

    /// Tells an answer in the page's next task, unless its batch is cancelled before.
    fn tell_soon(&self, batch: Batch, tell: Box<dyn FnOnce()>) {
        self.0.borrow_mut().untold.push(batch);
        let pool = self.clone();
        page::after(0, move || {
            let waiting = {
                let mut inner = pool.0.borrow_mut();
                let at = inner.untold.iter().position(|untold| *untold == batch);
                at.map(|at| inner.untold.remove(at)).is_some()
            };
            if waiting {
                tell();
            }
        });
    }

    /// Takes note of what a worker's engine has taken, and has it free when its task has ended; or gone, where they have become too large
    /// for so many, or this one has with what is not to come again for each photo.
    fn free(&self, id: usize, taken: f64, ended: bool) {
        let mut inner = self.0.borrow_mut();
        let Some(slot) = inner.slots.get_mut(&id) else { return };
        let apart = slot.task.as_ref().is_some_and(QueuedTask::is_apart);
        let outgrown = apart && taken > slot.taken.max(GROWN);
        if ended {
            (slot.task, slot.taken) = (None, taken);
        }
        // A single photo is not evidence about all photos.
        if !apart {
            inner.taken = inner.taken.max(taken);
        }
        if ended && (inner.slots.len() > inner.room() || outgrown) {
            let slot = inner.slots.remove(&id);
            drop(inner);
            discard(slot.into_iter().collect());
        }
    }

    /// A worker's memory only grows: when nothing is left to do, the one that has least stays.
    fn shrink(&self) {
        let ended = {
            let mut inner = self.0.borrow_mut();
            if !inner.queue.is_empty() || inner.slots.values().any(|slot| slot.task.is_some()) {
                return;
            }
            let ready = inner.slots.iter().filter(|(_, slot)| slot.ready);
            let stays = ready.min_by(|a, b| a.1.taken.total_cmp(&b.1.taken)).map(|(&id, _)| id);
            let ids = inner.slots.keys().copied().filter(|id| Some(*id) != stays).collect::<Vec<_>>();
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

/// A task with the way in which its words are understood: an invalid answer ends it and is reported.
fn job<T: Task + Into<Request>>(
    batch: Batch,
    task: T,
    files: Vec<Blob>,
    on_outcome: impl FnMut(TaskOutcome<T>) + 'static,
) -> QueuedTask {
    let on_outcome = Rc::new(RefCell::new(on_outcome));
    let listener = move |heard: Heard| {
        let outcome = match heard {
            Heard::Said(body, bytes) => match from_bytes::<SaidTo<T>>(&body) {
                Ok(Said::Progress(progress)) => TaskOutcome::Progress(progress),
                Ok(Said::Done(answer)) => TaskOutcome::Done(answer, bytes),
                Ok(Said::Refused(error)) => TaskOutcome::Failed(Failure::Refused(*error)),
                Ok(Said::Unreadable(detail)) => TaskOutcome::Failed(Failure::Unreadable(detail)),
                Err(detail) => TaskOutcome::Failed(Failure::Lost(detail)),
            },
            Heard::Lost(detail) => TaskOutcome::Failed(Failure::Lost(detail)),
        };
        let ends = !matches!(outcome, TaskOutcome::Progress(_));
        let on_outcome = on_outcome.clone();
        Understood { ends, tell: Box::new(move || (on_outcome.borrow_mut())(outcome)) }
    };
    QueuedTask { batch, request: task.into(), files, listener: Rc::new(listener), tried: false }
}
