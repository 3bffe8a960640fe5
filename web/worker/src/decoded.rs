//! Cache of decoded photos in a worker: decoding takes five times as long as detection, and a photo that was opened or clicked in
//! is most often the next one needed.

use std::cell::RefCell;

use sightline::Result;
use sightline::detection::Channel;
use sightline::sensor::Shot;

use crate::codecs::shot_of;

/// Size of the cache in bytes: two photos of 24 megapixels.
const CAPACITY: usize = 48 << 20;

/// Digest of the file, and the channel that was decoded.
type Key = (u64, Channel);

thread_local! {
    /// The most recently used is last.
    static CACHE: RefCell<Vec<(Key, Shot)>> = const { RefCell::new(Vec::new()) };
}

/// Digest of a file's content. Stored photos are keyed by it, so the function must never change.
pub fn digest(file: &[u8]) -> u64 {
    xxhash_rust::xxh3::xxh3_64(file)
}

/// Adds a photo to the cache; the least recently used are dropped if it is full.
pub fn keep(digest: u64, channel: Channel, photo: Shot) {
    CACHE.with_borrow_mut(|cache| put(cache, (digest, channel), photo));
}

/// Calls `work` with a photo, which is decoded only if the cache does not have it.
pub fn with_photo<T>(file: &[u8], digest: u64, channel: Channel, work: impl FnOnce(&Shot) -> Result<T>) -> Result<T> {
    let key = (digest, channel);
    CACHE.with_borrow_mut(|cache| {
        let photo = match cache.iter().position(|(known, _)| *known == key) {
            Some(at) => cache.remove(at).1,
            None => {
                trim(cache, CAPACITY / 2);
                shot_of(file, channel)?
            }
        };
        let done = work(&photo);
        put(cache, key, photo);
        done
    })
}

fn put(cache: &mut Vec<(Key, Shot)>, key: Key, photo: Shot) {
    cache.retain(|(known, _)| *known != key);
    cache.push((key, photo));
    trim(cache, CAPACITY);
}

/// Drops the least recently used photos until the others fit; the latest stays whatever its size.
fn trim(cache: &mut Vec<(Key, Shot)>, mut room: usize) {
    let mut count = 0;
    for (_, photo) in cache.iter().rev() {
        let size = photo.bytes();
        if size > room && count > 0 {
            break;
        }
        (room, count) = (room.saturating_sub(size), count + 1);
    }
    cache.drain(..cache.len() - count);
}
