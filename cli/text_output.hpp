// What every command prints: warnings on standard error, documents of JSON on standard output.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "compare/doubts/doubt.hpp"
#include "compare/report/number_text.hpp"
#include "compare/report/table.hpp"

namespace soilbin::cli {

using compare::as_text;
using compare::number;
using compare::Table;
using compare::TableCell;

/// Each on a line of its own to stderr, as `soilbin check` tells them: "warning: ...".
void print_warnings(const compare::Doubts& doubts);

/// A document on standard output, with what is doubtful in it.
void print_json(nlohmann::ordered_json document, const compare::Doubts& doubts = {});

}  // namespace soilbin::cli
