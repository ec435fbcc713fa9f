// Ctrl-C (SIGINT), SIGTERM and SIGHUP: exit code 130, and what was computed is kept.
#pragma once

namespace wilt::cli {

/// From now on one of these signals ends the program at once: there is nothing to keep yet, or all of it
/// stands in files already. Files are written whole or not at all (write_file), so none is spoilt. What was
/// started under nohup goes on when its terminal closes.
void end_on_interrupt();

/// From now on the first of these signals asks: interrupted() becomes true, and the computation stops soon
/// with what it has. The second ends the program at once, without what was not yet written.
void ask_on_interrupt();

/// Whether the user has asked to stop.
bool interrupted();

/// The computation has stopped; writing what it has is not to stop as well. The next signal ends the program.
void go_on_after_interrupt();

}  // namespace wilt::cli
