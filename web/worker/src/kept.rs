//! Decoded photos that a worker keeps: what is opened is most often detected next, and clicks stay in one photo, while decoding
//! takes five times as long as detecting.

use std::cell::RefCell;

use sightline::Result;
use sightline::detection::Channel;
use sightline::sensor::Shot;

use crate::codecs::shot_of;

/// Bytes that are kept: two photos of 24 megapixels.
const ROOM: usize = 48 << 20;

/// Tells photos with the same content, and their channels.
type Key = (u64, Channel);

thread_local! {
    /// The latest at the end.
    static KEPT: RefCell<Vec<(Key, Shot)>> = const { RefCell::new(Vec::new()) };
}

/// Tells files with the same content; kept photos go by it, so it stays the same for ever.
pub fn digest(file: &[u8]) -> u64 {
    xxhash_rust::xxh3::xxh3_64(file)
}

/// Keeps a photo; the oldest go where room is short.
pub fn keep(digest: u64, channel: Channel, photo: Shot) {
    KEPT.with_borrow_mut(|kept| put(kept, (digest, channel), photo));
}

/// Works on a photo, decoding it only where it is not kept.
pub fn with_photo<T>(file: &[u8], digest: u64, channel: Channel, work: impl FnOnce(&Shot) -> Result<T>) -> Result<T> {
    let key = (digest, channel);
    KEPT.with_borrow_mut(|kept| {
        let photo = match kept.iter().position(|(known, _)| *known == key) {
            Some(at) => kept.remove(at).1,
            None => {
                trim(kept, ROOM / 2);
                shot_of(file, channel)?
            }
        };
        let done = work(&photo);
        put(kept, key, photo);
        done
    })
}

fn put(kept: &mut Vec<(Key, Shot)>, key: Key, photo: Shot) {
    kept.retain(|(known, _)| *known != key);
    kept.push((key, photo));
    trim(kept, ROOM);
}

/// Lets the oldest go until the others have room; the latest stays whatever its size.
fn trim(kept: &mut Vec<(Key, Shot)>, mut room: usize) {
    let mut count = 0;
    for (_, photo) in kept.iter().rev() {
        let size = photo.bytes();
        if size > room && count > 0 {
            break;
        }
        (room, count) = (room.saturating_sub(size), count + 1);
    }
    kept.drain(..kept.len() - count);
}
