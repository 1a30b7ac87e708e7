// One function a command: each adds its subcommand and options, and says what to do once they are parsed.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "cli/workplace.hpp"

namespace soilbin::cli {

/// How a program ends.
/// `unfinished`: part of the work is done and kept; the same command goes on from there.
enum ExitStatus { done = 0, failed = 1, bad_input = 2, unfinished = 3, interrupted = 130 };

/// What the commands share.
struct Session {
  Workplace place;
  std::string command;          ///< as it was typed, words quoted where a shell needs it
  std::function<int()> action;  ///< of the subcommand that was parsed; gives the exit status
};

void add_estimate(CLI::App& app, Session& session);
void add_explain(CLI::App& app, Session& session);
void add_run(CLI::App& app, Session& session);
void add_bed(CLI::App& app, Session& session);
void add_mesh(CLI::App& app, Session& session);
void add_record(CLI::App& app, Session& session);
void add_sweep(CLI::App& app, Session& session);
void add_element_test(CLI::App& app, Session& session);
void add_bevameter(CLI::App& app, Session& session);
void add_drive(CLI::App& app, Session& session);
void add_runs(CLI::App& app, Session& session);
void add_plates(CLI::App& app, Session& session);
void add_shear(CLI::App& app, Session& session);
void add_limits(CLI::App& app, Session& session);
void add_mobility(CLI::App& app, Session& session);
void add_vehicle(CLI::App& app, Session& session);
void add_predict(CLI::App& app, Session& session);
void add_calibrate(CLI::App& app, Session& session);
void add_campaign(CLI::App& app, Session& session);
void add_design(CLI::App& app, Session& session);
void add_loop(CLI::App& app, Session& session);
void add_compare(CLI::App& app, Session& session);
void add_failure_map(CLI::App& app, Session& session);
void add_report(CLI::App& app, Session& session);
void add_reproduce(CLI::App& app, Session& session);
void add_export(CLI::App& app, Session& session);
void add_serve(CLI::App& app, Session& session);
void add_check(CLI::App& app, Session& session);
void add_init(CLI::App& app, Session& session);
void add_list(CLI::App& app, Session& session);
void add_schema(CLI::App& app, Session& session);
void add_verify(CLI::App& app, Session& session);
void add_doctor(CLI::App& app, Session& session);
void add_manual(CLI::App& app, Session& session);

}  // namespace soilbin::cli
