//! Independent work on as many threads as there are processors.

/// What `work` makes of each job, in their order. Drivers compile one pipeline per thread.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn at_once<'a, T: Sync, R: Send>(
    jobs: &'a [T],
    work: impl Fn(&'a T) -> R + Sync,
) -> Vec<R> {
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::thread;

    let processors = thread::available_parallelism().map_or(1, usize::from);
    let next = AtomicUsize::new(0);
    let take = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(job) = jobs.get(index) else {
                return done;
            };
            done.push((index, work(job)));
        }
    };
    let mut done = thread::scope(|scope| {
        // A thread that the system does not give leaves its share to the others.
        let helpers = (1..processors.min(jobs.len()))
            .map_while(|_| thread::Builder::new().spawn_scoped(scope, take).ok());
        let helpers: Vec<_> = helpers.collect();
        let mut done = take();
        for helper in helpers {
            match helper.join() {
                Ok(others) => done.extend(others),
                Err(panic) => std::panic::resume_unwind(panic),
            }
        }
        done
    });
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, made)| made).collect()
}

/// What `work` makes of each job, one after the other: a browser has its own threads for this.
#[cfg(target_arch = "wasm32")]
pub(super) fn at_once<'a, T, R>(jobs: &'a [T], work: impl Fn(&'a T) -> R) -> Vec<R> {
    jobs.iter().map(work).collect()
}
