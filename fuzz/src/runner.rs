//! Runs a target in a process of its own, so that an abort, a hang and boundless memory are findings like any panic.

use std::fs;
use std::io::{self, Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::time::{Duration, Instant};

use crate::Target;

/// An input that takes more of the processor's time than this hangs.
pub const LONGEST: Duration = Duration::from_secs(10);

/// So does one that takes longer than this: it may wait for something, on a machine that is busy with other things.
pub const LONGEST_WAIT: Duration = Duration::from_secs(60);

/// A process that takes more memory than this is stopped.
pub const MOST_BYTES: u64 = 4 << 30;

/// What a target is run with.
#[derive(Clone, Debug)]
pub struct Run {
    /// The seed of the mutations.
    pub seed: u64,
    /// The number of the first input.
    pub first: u64,
    /// How many inputs at most.
    pub iterations: u64,
    /// For how long at most.
    pub time: Duration,
}

/// How a run ended.
#[derive(Clone, Debug, Default)]
pub struct Summary {
    /// How many inputs were tried out.
    pub inputs: u64,
    /// How many of them were valid.
    pub valid: u64,
    /// The longest that one took.
    pub slowest: Duration,
    /// The number of that one.
    pub slowest_input: u64,
    /// What was found: the number of the input, and what it did.
    pub finding: Option<(u64, String)>,
}

/// What is written instead of a number when no input is left.
const END: u64 = u64::MAX >> 1;

/// Tries inputs out in this process, and writes the number of each to the standard output before it does: twice that number, and one more
/// if the input before was valid.
///
/// # Errors
/// If nobody reads the output.
pub fn work(target: &Target, seeds: &[Vec<u8>], run: &Run) -> io::Result<()> {
    let begin = Instant::now();
    let mut out = io::stdout().lock();
    let mut was_valid = false;
    for iteration in (run.first..).take(usize::try_from(run.iterations).unwrap_or(usize::MAX)) {
        if begin.elapsed() > run.time {
            break;
        }
        out.write_all(&(2 * iteration + u64::from(was_valid)).to_le_bytes())?;
        out.flush()?;
        let input = target.input(seeds, run.seed, iteration);
        was_valid = (target.try_out)(&input);
    }
    out.write_all(&(2 * END + u64::from(was_valid)).to_le_bytes())?;
    out.flush()
}

/// Starts `command`, which calls [`work`], in a folder of its own, and watches it.
///
/// # Errors
/// If the process cannot be started or the folder cannot be read.
pub fn watch(mut command: Command) -> io::Result<Summary> {
    let folder = tempfile::tempdir()?;
    let begin = Instant::now();
    let mut child = command
        .current_dir(folder.path())
        .env("TMPDIR", folder.path())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .spawn()?;
    let numbers = numbers(&mut child);
    let mut summary = Summary::default();
    let mut current = None;
    let mut since = begin;
    let mut processor_before = None;
    loop {
        match numbers.recv_timeout(Duration::from_millis(200)) {
            Ok(written) => {
                let (number, was_valid) = (written / 2, written % 2);
                if let Some(input) = current {
                    summary.valid += was_valid;
                    summary.inputs += 1;
                    if since.elapsed() > summary.slowest {
                        summary.slowest = since.elapsed();
                        summary.slowest_input = input;
                    }
                }
                current = (number != END).then_some(number);
                since = Instant::now();
                processor_before = None;
                continue;
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        let processor = processor_time(child.id());
        let worked = processor - *processor_before.get_or_insert(processor);
        let hangs = current.is_some() && (worked > LONGEST || since.elapsed() > LONGEST_WAIT);
        let memory = resident_bytes(child.id());
        if hangs || memory > MOST_BYTES {
            child.kill()?;
            child.wait()?;
            let what = if hangs {
                format!("it hangs: no result after {:.0?}", since.elapsed())
            } else {
                format!("it takes {} MiB of memory", memory >> 20)
            };
            summary.finding = Some((current.unwrap_or_default(), what));
            return Ok(summary);
        }
    }
    let status = child.wait()?;
    summary.finding = finding(status, current, folder.path())?;
    Ok(summary)
}

fn finding(
    status: ExitStatus,
    current: Option<u64>,
    folder: &Path,
) -> io::Result<Option<(u64, String)>> {
    if let Some(input) = current {
        return Ok(Some((
            input,
            format!("it ended the process: {status}; see above"),
        )));
    }
    if !status.success() {
        return Ok(Some((
            0,
            format!("the process failed outside of any input: {status}"),
        )));
    }
    let mut left = Vec::new();
    for entry in fs::read_dir(folder)? {
        left.push(entry?.file_name().to_string_lossy().into_owned());
    }
    Ok((!left.is_empty()).then(|| (0, format!("files are left behind: {}", left.join(", ")))))
}

/// The numbers that the process writes.
fn numbers(child: &mut Child) -> Receiver<u64> {
    let (send, receive) = mpsc::channel();
    if let Some(mut out) = child.stdout.take() {
        std::thread::spawn(move || {
            let mut bytes = [0; 8];
            while out.read_exact(&mut bytes).is_ok() && send.send(u64::from_le_bytes(bytes)).is_ok()
            {
            }
        });
    }
    receive
}

/// The processor's time that a process has taken, over all its threads; 0 where the system does not tell.
fn processor_time(process: u32) -> Duration {
    /// As every Linux has it.
    const TICKS_PER_SECOND: u64 = 100;
    let stat = fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    // The second field is the name in parentheses; the 14th and 15th are user and system time.
    let fields = stat.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks = fields.split_whitespace().skip(11).take(2);
    let ticks: u64 = ticks.filter_map(|ticks| ticks.parse::<u64>().ok()).sum();
    Duration::from_millis(ticks * 1000 / TICKS_PER_SECOND)
}

/// The memory of a process; 0 where the system does not tell.
fn resident_bytes(process: u32) -> u64 {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"));
    let kilobytes = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    kilobytes.unwrap_or(0) << 10
}
