#include "wilt/reproduce/program.hpp"

#include <boost/process.hpp>
#include <iterator>
#include <system_error>

namespace wilt {

namespace process = boost::process;

ProgramOutput run_program(const std::string& name, const std::vector<std::string>& arguments,
                          const std::string& folder) {
  ProgramOutput output;
  const auto program = process::search_path(name);
  if (program.empty()) return output;
  std::error_code failed;
  process::ipstream text;
  process::group own;  // out of reach of the terminal's Ctrl-C
  process::child child(program, process::args(arguments), process::start_dir(folder), process::std_in.close(),
                       process::std_out > text, process::std_err > process::null, own, failed);
  if (failed) return output;
  output.started = true;
  output.text.assign(std::istreambuf_iterator<char>(text), {});
  child.wait(failed);
  output.exit_code = child.exit_code();
  return output;
}

}  // namespace wilt
