//! A plugin for QEMU's translator (plugin interface, version 1). It counts the instructions that a guest executes
//! between the functions `octray_begin` and `octray_end`, by kind and by function. Counts are exact, and the same in
//! every run.
//!
//! ```text
//! qemu-system-arm … -plugin liboctray_count.so,out=FILE,watch=nearest:kernel_*
//! ```
//!
//! When the guest ends, FILE holds
//!
//! | line | meaning |
//! | --- | --- |
//! | `instructions N` | all instructions |
//! | `longest N` | those of the longest period from `octray_begin` to `octray_end`: the dearest strip of a frame |
//! | `class NAME N`, `kind NAME N` | instructions of each [`octray_instruction::Class`], and of each [`Kind`] |
//! | `taken N`, `moved N` | taken conditional branches; registers moved by loads and stores of several registers |
//! | `calls N M NAME` | calls of a watched function, and the instructions from their entries to their returns |
//! | `function N NAME` | instructions in each function's own code, the most expensive first |

mod counters;
mod path;
mod qemu;

use counters::{Counters, What};
use octray_instruction::{Kind, moved};
use path::{Block, Path};
use std::ffi::{CStr, c_char, c_int, c_uint, c_void};
use std::sync::atomic::AtomicU64;
use std::sync::{Mutex, PoisonError};
use std::{fs, ptr, slice};

/// The version of QEMU's plugin interface that this plugin uses.
#[unsafe(no_mangle)]
pub static qemu_plugin_version: c_int = 1;

struct State {
    out: String,
    watch: Vec<String>,
    counters: Counters,
    path: Path,
}

static STATE: Mutex<State> = Mutex::new(State {
    out: String::new(),
    watch: Vec::new(),
    counters: Counters::new(),
    path: Path::new(),
});

fn with_state<T>(f: impl FnOnce(&mut State) -> T) -> T {
    let mut state = STATE.lock().unwrap_or_else(PoisonError::into_inner);
    f(&mut state)
}

/// Called by QEMU when it loads the plugin.
///
/// # Safety
/// `argv` must be `argc` strings that end in a null byte; QEMU guarantees it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qemu_plugin_install(
    id: u64,
    _info: *const c_void,
    argc: c_int,
    argv: *const *const c_char,
) -> c_int {
    let arguments = match argc {
        1.. if !argv.is_null() => {
            // SAFETY: by this function's contract.
            unsafe { slice::from_raw_parts(argv, argc as usize) }
        }
        _ => &[],
    };
    for &argument in arguments {
        // SAFETY: by this function's contract.
        let text = unsafe { CStr::from_ptr(argument) }.to_string_lossy();
        if let Some(path) = text.strip_prefix("out=") {
            with_state(|state| state.out = path.to_owned());
        } else if let Some(names) = text.strip_prefix("watch=") {
            with_state(|state| state.watch = names.split(':').map(Into::into).collect());
        }
    }
    if with_state(|state| state.out.is_empty()) {
        eprintln!("octray-count: expected out=FILE");
        return 1;
    }
    // SAFETY: the callbacks live as long as the plugin.
    unsafe {
        qemu::qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
        qemu::qemu_plugin_register_atexit_cb(id, at_exit, ptr::null_mut());
    }
    0
}

/// Handles the translation of a block: gives a counter to each of its instructions.
extern "C" fn translated(_: u64, block: *mut qemu::Block) {
    let mut seen = Block {
        start: 0,
        next: 0,
        length: 0,
        taken: None,
        watched: None,
    };
    // SAFETY: QEMU lends the block and its instructions until this function returns.
    unsafe {
        for i in 0..qemu::qemu_plugin_tb_n_insns(block) {
            let instruction = qemu::qemu_plugin_tb_get_insn(block, i);
            let function = text(qemu::qemu_plugin_insn_symbol(instruction));
            let function = format!("{:#}", rustc_demangle::demangle(&function));
            let disassembled = qemu::qemu_plugin_insn_disas(instruction);
            let disassembly = text(disassembled);
            qemu::g_free(disassembled.cast_mut().cast());
            let address = qemu::qemu_plugin_insn_vaddr(instruction);
            if i == 0 {
                seen.start = address;
                match &*function {
                    "octray_begin" => mark(instruction, resume),
                    "octray_end" => mark(instruction, pause),
                    _ => {}
                }
                with_state(|state| {
                    let watched = path::watched(&function, &state.watch);
                    seen.watched = watched.then(|| function.clone());
                });
            }
            seen.next = address + qemu::qemu_plugin_insn_size(instruction) as u64;
            seen.length += 1;
            let kind = Kind::of(&disassembly);
            seen.taken = (kind == Kind::BranchIf).then(|| counter(What::Taken));
            add(instruction, counter(What::Executed(function, kind)), 1);
            if matches!(kind, Kind::Multiple | Kind::MultipleReturn) {
                add(instruction, counter(What::Moved), moved(&disassembly));
            }
        }
        let seen: *mut Block = Box::leak(Box::new(seen));
        qemu::qemu_plugin_register_vcpu_tb_exec_cb(
            block,
            block_entered,
            qemu::NO_REGISTERS,
            seen.cast(),
        );
    }
}

fn counter(what: What) -> &'static AtomicU64 {
    with_state(|state| state.counters.counter(what))
}

/// # Safety
/// `instruction` must be of the block that is being translated.
unsafe fn add(instruction: *mut qemu::Instruction, counter: &'static AtomicU64, n: u64) {
    // SAFETY: by this function's contract; boards have one core, so there is no concurrent addition.
    unsafe {
        qemu::qemu_plugin_register_vcpu_insn_exec_inline(
            instruction,
            qemu::ADD_U64,
            counter.as_ptr().cast(),
            n,
        );
    }
}

/// # Safety
/// `instruction` must be of the block that is being translated.
unsafe fn mark(instruction: *mut qemu::Instruction, then: qemu::Executed) {
    // SAFETY: by this function's contract; the callback has no data.
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
unsafe fn text(text: *const c_char) -> String {
    if text.is_null() {
        return "?".into();
    }
    // SAFETY: by this function's contract.
    unsafe { CStr::from_ptr(text) }
        .to_string_lossy()
        .into_owned()
}

extern "C" fn block_entered(_: c_uint, block: *mut c_void) {
    // SAFETY: `translated` registers a block that is never freed.
    let block: &'static Block = unsafe { &*block.cast_const().cast() };
    with_state(|state| state.path.enter(block, &mut state.counters));
}

extern "C" fn resume(_: c_uint, _: *mut c_void) {
    with_state(|state| state.counters.run(true));
}

extern "C" fn pause(_: c_uint, _: *mut c_void) {
    with_state(|state| state.counters.run(false));
}

extern "C" fn at_exit(_: u64, _: *mut c_void) {
    let (out, report) = with_state(|state| (state.out.clone(), state.counters.report()));
    if let Err(error) = fs::write(&out, report) {
        eprintln!("octray-count: cannot write {out}: {error}");
    }
}
