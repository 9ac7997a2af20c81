//! Work that several threads share.

use std::sync::Mutex;

use crate::Failure;

/// Hands out `items` to so many workers, which are numbered from 1, until none is left or one fails.
pub fn share<T: Send>(
    items: impl Iterator<Item = T> + Send,
    workers: usize,
    work: impl Fn(T, usize) -> Result<(), Failure> + Sync,
) -> Result<(), Failure> {
    let queue = Mutex::new(items);
    let next = || queue.lock().expect("no worker panics").next();
    let one = |worker: usize| -> Result<(), String> {
        while let Some(item) = next() {
            work(item, worker).map_err(|why| why.to_string())?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        let one = &one;
        let workers: Vec<_> = (1..=workers).map(|k| scope.spawn(move || one(k))).collect();
        workers.into_iter().try_for_each(|worker| worker.join().expect("no worker panics"))
    })?;
    Ok(())
}
