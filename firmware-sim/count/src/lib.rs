//! A plugin of QEMU's translator (its plugin interface, version 1) that counts the instructions a
//! guest executes between the functions `octray_resume` and `octray_pause`, by class and by
//! function. Counting is exact, and the same in every run.
//!
//! ```text
//! qemu-system-arm … -plugin liboctray_count.so,out=FILE
//! ```
//!
//! At the guest's end FILE holds a line `instructions N`, a line `class NAME N` for each class,
//! and a line `function NAME N` for each function, the costliest first.

mod class;
mod qemu;

pub use class::Class;

use std::collections::BTreeMap;
use std::ffi::{CStr, c_char, c_int, c_uint, c_void};
use std::fmt::Write;
use std::sync::{Mutex, PoisonError};
use std::{fs, ptr, slice};

/// The version of the interface that this plugin speaks, for QEMU.
#[unsafe(no_mangle)]
pub static qemu_plugin_version: c_int = 1;

/// Executions of all instructions of one class in one function.
struct Counter {
    /// Grows while the guest runs; QEMU adds to it.
    now: *mut u64,
    /// Its value when counting was last resumed.
    start: u64,
    /// What counts.
    sum: u64,
}

// SAFETY: the pointer is to memory that is never freed; boards have one core, so that nobody adds
// while it is read.
unsafe impl Send for Counter {}

struct State {
    out: String,
    running: bool,
    counters: BTreeMap<(String, Class), Counter>,
}

static STATE: Mutex<State> = Mutex::new(State {
    out: String::new(),
    running: false,
    counters: BTreeMap::new(),
});

fn with_state<T>(f: impl FnOnce(&mut State) -> T) -> T {
    let mut state = STATE.lock().unwrap_or_else(PoisonError::into_inner);
    f(&mut state)
}

impl State {
    /// The counter of a class in a function.
    fn counter(&mut self, function: &str, class: Class) -> *mut u64 {
        let key = (function.to_owned(), class);
        let new = || Counter {
            now: Box::leak(Box::new(0)),
            start: 0,
            sum: 0,
        };
        self.counters.entry(key).or_insert_with(new).now
    }

    fn run(&mut self, running: bool) {
        for counter in self.counters.values_mut() {
            // SAFETY: see `Counter`.
            let now = unsafe { ptr::read_volatile(counter.now) };
            if self.running {
                counter.sum += now - counter.start;
            }
            counter.start = now;
        }
        self.running = running;
    }

    fn report(&self) -> String {
        let mut classes: BTreeMap<Class, u64> = BTreeMap::new();
        let mut functions: BTreeMap<&str, u64> = BTreeMap::new();
        for ((function, class), counter) in &self.counters {
            *classes.entry(*class).or_default() += counter.sum;
            *functions.entry(function).or_default() += counter.sum;
        }
        let mut functions: Vec<_> = functions.into_iter().filter(|(_, n)| *n > 0).collect();
        functions.sort_by_key(|&(name, n)| (std::cmp::Reverse(n), name));
        let all: u64 = classes.values().sum();
        let mut text = format!("instructions {all}\n");
        // Writing to a string cannot fail.
        for (class, n) in classes {
            let _ = writeln!(text, "class {} {n}", class.name());
        }
        for (name, n) in functions {
            let _ = writeln!(text, "function {name} {n}");
        }
        text
    }
}

/// Called by QEMU when it loads the plugin.
///
/// # Safety
/// `argv` must be `argc` strings that end in a null byte, as QEMU hands over.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qemu_plugin_install(
    id: u64,
    _info: *const c_void,
    argc: c_int,
    argv: *const *const c_char,
) -> c_int {
    // SAFETY: by this function's contract.
    let arguments = unsafe { slice::from_raw_parts(argv, argc.max(0) as usize) };
    for &argument in arguments {
        // SAFETY: the same.
        let text = unsafe { CStr::from_ptr(argument) }.to_string_lossy();
        if let Some(path) = text.strip_prefix("out=") {
            with_state(|state| state.out = path.to_owned());
        }
    }
    if with_state(|state| state.out.is_empty()) {
        eprintln!("octray-count: say out=FILE");
        return 1;
    }
    // SAFETY: the callbacks live as long as the plugin.
    unsafe {
        qemu::qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
        qemu::qemu_plugin_register_atexit_cb(id, at_exit, ptr::null_mut());
    }
    0
}

/// A block of the guest has been translated: each of its instructions gets its counter.
extern "C" fn translated(_: u64, block: *mut qemu::Block) {
    // SAFETY: QEMU lends the block and its instructions until this function returns.
    unsafe {
        for i in 0..qemu::qemu_plugin_tb_n_insns(block) {
            let instruction = qemu::qemu_plugin_tb_get_insn(block, i);
            let function = name(qemu::qemu_plugin_insn_symbol(instruction));
            let first = i == 0;
            if first && function == "octray_resume" {
                mark(instruction, resume);
            } else if first && function == "octray_pause" {
                mark(instruction, pause);
            }
            let disassembly = qemu::qemu_plugin_insn_disas(instruction);
            let class = Class::of(&name(disassembly));
            qemu::g_free(disassembly.cast_mut().cast());
            let counter = with_state(|state| state.counter(&function, class));
            qemu::qemu_plugin_register_vcpu_insn_exec_inline(
                instruction,
                qemu::ADD_U64,
                counter.cast(),
                1,
            );
        }
    }
}

/// # Safety
/// `instruction` must be of the block that is being translated.
unsafe fn mark(instruction: *mut qemu::Instruction, then: qemu::Executed) {
    // SAFETY: by this function's contract; there is no data for the callback.
    unsafe {
        qemu::qemu_plugin_register_vcpu_insn_exec_cb(
            instruction,
            then,
            qemu::NO_REGISTERS,
            ptr::null_mut(),
        );
    }
}

/// # Safety
/// `text` must be null or end in a null byte.
unsafe fn name(text: *const c_char) -> String {
    if text.is_null() {
        return "?".into();
    }
    // SAFETY: by this function's contract.
    unsafe { CStr::from_ptr(text) }
        .to_string_lossy()
        .into_owned()
}

extern "C" fn resume(_: c_uint, _: *mut c_void) {
    with_state(|state| state.run(true));
}

extern "C" fn pause(_: c_uint, _: *mut c_void) {
    with_state(|state| state.run(false));
}

extern "C" fn at_exit(_: u64, _: *mut c_void) {
    let (out, report) = with_state(|state| (state.out.clone(), state.report()));
    if let Err(error) = fs::write(&out, report) {
        eprintln!("octray-count: cannot write {out}: {error}");
    }
}
