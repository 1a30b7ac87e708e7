// HTTP for one machine. The only file that knows Boost.Beast is server.cpp.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "cli/serve/reply.hpp"

namespace soilbin::cli {

/// What answers a target, such as "/estimate?slip=20%25". It may throw GivenUp.
using Answering = std::function<Reply(std::string_view target, const StillWanted& wanted)>;

/// Answers GET and HEAD at 127.0.0.1 until Ctrl-C (SIGINT) or SIGTERM. `port` 0: any free one. `listening` is called
/// once with the address, "http://127.0.0.1:8080/". One thread; answers come one at a time. Requests that name another
/// host are refused, so that no other web page can read the answers. Throws InputError with a hint where the port can't
/// be had.
void serve_http(unsigned short port, const std::function<void(const std::string& address)>& listening,
                const Answering& answer);

}  // namespace soilbin::cli
