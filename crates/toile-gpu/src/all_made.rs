//! The future of all pipelines of a device: natively threads make them, in a browser the browser does.

use crate::GpuError;
use std::pin::Pin;
use std::task::{Context, Poll};

/// Ready once every pipeline is made; see [`Kernels::all_made`](crate::Kernels::all_made). One that is dropped stops nothing.
#[must_use = "a future does nothing for its host until it is awaited"]
pub struct AllMade(Pin<Box<Made>>);

/// What is awaited. In a browser nothing crosses threads.
#[cfg(target_arch = "wasm32")]
type Made = dyn Future<Output = Result<(), GpuError>>;
#[cfg(not(target_arch = "wasm32"))]
type Made = dyn Future<Output = Result<(), GpuError>> + Send;

impl AllMade {
    #[cfg(target_arch = "wasm32")]
    pub(crate) fn of(made: impl Future<Output = Result<(), GpuError>> + 'static) -> Self {
        Self(Box::pin(made))
    }

    /// What a thread of its own does.
    #[cfg(not(target_arch = "wasm32"))]
    pub(crate) fn by_thread(work: impl FnOnce() -> Result<(), GpuError> + Send + 'static) -> Self {
        let told = std::sync::Arc::new(std::sync::Mutex::new(thread::Told::default()));
        let teller = thread::Teller(told.clone());
        let spawned = std::thread::Builder::new().name("pipelines of toile".to_owned()).spawn(move || {
            // Dropped also where the work panics, so that nobody waits for good.
            let teller = teller;
            teller.tell(work());
        });
        if let Err(error) = spawned {
            thread::Teller(told.clone()).tell(Err(GpuError::Device(format!("no thread for its pipelines: {error}"))));
        }
        Self(Box::pin(thread::Listener(told)))
    }
}

impl Future for AllMade {
    type Output = Result<(), GpuError>;

    fn poll(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
        self.0.as_mut().poll(context)
    }
}

impl std::fmt::Debug for AllMade {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("AllMade")
    }
}

#[cfg(not(target_arch = "wasm32"))]
mod thread {
    use crate::GpuError;
    use std::pin::Pin;
    use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
    use std::task::{Context, Poll, Waker};

    /// What the thread has told, and who waits for it.
    #[derive(Default)]
    pub(super) struct Told {
        outcome: Option<Result<(), GpuError>>,
        waker: Option<Waker>,
    }

    /// The end of the thread.
    pub(super) struct Teller(pub(super) Arc<Mutex<Told>>);

    /// The end of the host.
    pub(super) struct Listener(pub(super) Arc<Mutex<Told>>);

    fn locked(told: &Mutex<Told>) -> MutexGuard<'_, Told> {
        told.lock().unwrap_or_else(PoisonError::into_inner)
    }

    impl Teller {
        pub(super) fn tell(&self, outcome: Result<(), GpuError>) {
            let mut told = locked(&self.0);
            told.outcome.get_or_insert(outcome);
            let waker = told.waker.take();
            drop(told);
            waker.into_iter().for_each(Waker::wake);
        }
    }

    impl Drop for Teller {
        fn drop(&mut self) {
            let ended = "the thread that makes its pipelines ended before they were made".to_owned();
            self.tell(Err(GpuError::Device(ended)));
        }
    }

    impl Future for Listener {
        type Output = Result<(), GpuError>;

        fn poll(self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Self::Output> {
            let mut told = locked(&self.0);
            match told.outcome.take() {
                Some(outcome) => Poll::Ready(outcome),
                None => {
                    told.waker = Some(context.waker().clone());
                    Poll::Pending
                }
            }
        }
    }

    #[cfg(test)]
    mod tests {
        use crate::GpuError;
        use crate::all_made::AllMade;

        #[test]
        fn what_the_thread_tells_is_heard_and_its_end_too() {
            assert!(pollster::block_on(AllMade::by_thread(|| Ok(()))).is_ok());
            let failed = AllMade::by_thread(|| Err(GpuError::Device("gone".to_owned())));
            assert!(matches!(pollster::block_on(failed), Err(GpuError::Device(what)) if what == "gone"));
            let ended = pollster::block_on(AllMade::by_thread(|| panic!("as it is to be in this test")));
            assert!(ended.is_err_and(|error| error.to_string().contains("ended before they were made")));
        }
    }
}
