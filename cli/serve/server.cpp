#include "cli/serve/server.hpp"

#include <fmt/core.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <list>
#include <optional>

#include "cli/progress.hpp"
#include "scenario/errors.hpp"

namespace soilbin::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using Request = http::request<http::string_body>;
using Response = http::response<http::string_body>;

constexpr std::chrono::seconds patience{60};  ///< with a browser that says nothing
constexpr std::size_t largest_body = 1024;    ///< [bytes] of a request; none is needed
constexpr std::uint32_t largest_head = 8192;  ///< [bytes] of a request's first line and its header

/// Connections at once: 64, or what the system lets this process have beside a dozen other descriptors.
std::size_t most_connections() {
  constexpr rlim_t enough = 64, others = 16;
  rlimit allowed{};
  if (::getrlimit(RLIMIT_NOFILE, &allowed) != 0) return enough;
  return std::clamp<rlim_t>(allowed.rlim_cur > others ? allowed.rlim_cur - others : 1, 1, enough);
}

/// "localhost", "127.0.0.1", and either with a port: which one, a tunnel may have changed.
bool names_this_machine(beast::string_view host) {
  const std::size_t colon = std::min(host.find(':'), host.size());
  const beast::string_view name = host.substr(0, colon), port = host.substr(std::min(colon + 1, host.size()));
  const bool digits = std::ranges::all_of(port, [](char c) { return c >= '0' && c <= '9'; });
  return digits && port.size() <= 5 && (name == "127.0.0.1" || name == "localhost");
}

/// Whether another site's page asks, as browsers tell; a link that opens the live page itself is none of this.
bool is_foreign(const Request& request) {
  const beast::string_view site = request["Sec-Fetch-Site"];
  const bool opens_page =
      request["Sec-Fetch-Dest"] == "document" && (request.target() == "/" || request.target().starts_with("/?"));
  return !site.empty() && site != "same-origin" && site != "none" && !opens_page;
}

/// Whether the other end is still there: one that has hung up leaves nothing to read.
bool is_open(tcp::socket& socket) {
  char next = 0;
  return ::recv(socket.native_handle(), &next, 1, MSG_PEEK | MSG_DONTWAIT) != 0;
}

Reply reply_to_request(const Request& request, const Answering& answer, const StillWanted& wanted) {
  if (!names_this_machine(request[http::field::host]))
    return refusal(403, "this server answers its own machine only\n  hint: open the address that it printed");
  if (is_foreign(request))
    return refusal(403, "this server answers its own page only\n  hint: open the address that it printed");
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return refusal(405, "only GET is answered");
  const beast::string_view target = request.target();
  try {
    return answer({target.data(), target.size()}, wanted);
  } catch (const GivenUp&) {
    throw;
  } catch (const std::exception& error) {
    return refusal(500, fmt::format("this could not be answered: {}", error.what()));
  }
}

Response response_of(Reply reply, unsigned version, bool with_body, bool keep_alive) {
  Response response(static_cast<http::status>(reply.status), version);
  response.set(http::field::content_type, reply.type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.keep_alive(keep_alive);
  response.content_length(reply.body.size());
  if (with_body) response.body() = std::move(reply.body);
  return response;
}

/// What is owed to who sent something else than a request that is answered; nothing where he is gone or too slow.
std::optional<Reply> reply_to_error(const beast::error_code& error) {
  const auto is = [&](http::error kind) { return error == kind; };
  if (is(http::error::header_limit) || is(http::error::buffer_overflow))
    return refusal(414,
                   fmt::format("the request is longer than {} bytes\n  hint: fewer or shorter flags", largest_head));
  if (is(http::error::body_limit)) return refusal(413, "no body is needed\n  hint: only GET is answered");
  if (is(http::error::end_of_stream) || is(http::error::partial_message)) return std::nullopt;
  if (error.category() == make_error_code(http::error::bad_method).category())
    return refusal(400, "this is no HTTP request");
  return std::nullopt;
}

/// Connections that are open, the one that has been silent longest first: there are never more than so many, so that
/// the process always has descriptors left.
class Connections {
 public:
  using Place = std::list<beast::tcp_stream*>::iterator;

  Place open(beast::tcp_stream& stream) {
    if (open_.size() >= most_) close_oldest();
    return open_.insert(open_.end(), &stream);
  }
  void heard_of(Place place) { open_.splice(open_.end(), open_, place); }
  void close(Place place) { open_.erase(place); }
  void close_oldest() {
    if (open_.empty()) return;
    heard_of(open_.begin());                 // the next one that has to go is another
    open_.back()->socket().close(ignored_);  // its conversation ends, and gives up its place
  }

 private:
  const std::size_t most_ = most_connections();
  std::list<beast::tcp_stream*> open_;
  beast::error_code ignored_;
};

/// Reads what still comes for a moment: a socket that is closed with something unread takes the last reply with it.
asio::awaitable<void> hear_out(beast::tcp_stream& stream) {
  constexpr std::size_t enough = 1U << 20U;
  std::array<char, 4096> rest{};
  stream.expires_after(std::chrono::seconds(1));
  for (std::size_t heard = 0; heard < enough;)
    heard += co_await stream.async_read_some(asio::buffer(rest), asio::use_awaitable);
}

/// Answers requests until one asks for no more. Throws system_error where the connection ends or fails, GivenUp where
/// it has ended before its answer was found.
asio::awaitable<void> answer_requests(beast::tcp_stream& stream, const Answering& answer,
                                      const std::function<void()>& heard) {
  beast::flat_buffer buffer;
  const StillWanted wanted = [&stream] { return is_open(stream.socket()); };
  for (bool more = true; more;) {
    stream.expires_after(patience);
    http::request_parser<http::string_body> parser;
    parser.header_limit(largest_head);
    parser.body_limit(largest_body);
    beast::error_code error;
    co_await http::async_read(stream, buffer, parser, asio::redirect_error(asio::use_awaitable, error));
    heard();
    if (!error) {
      const Request& request = parser.get();
      const Response response = response_of(reply_to_request(request, answer, wanted), request.version(),
                                            request.method() != http::verb::head, request.keep_alive());
      co_await http::async_write(stream, response, asio::use_awaitable);
      more = response.keep_alive();
    } else if (std::optional<Reply> owed = reply_to_error(error)) {
      constexpr unsigned http_1_1 = 11;
      const Response response = response_of(std::move(*owed), http_1_1, true, false);
      co_await http::async_write(stream, response, asio::use_awaitable);
      stream.socket().shutdown(tcp::socket::shutdown_send);
      co_await hear_out(stream);
      more = false;
    } else {
      more = false;
    }
  }
}

/// One connection, to its end.
asio::awaitable<void> converse(beast::tcp_stream stream, Connections& connections, const Answering& answer) {
  const Connections::Place place = connections.open(stream);
  const std::function<void()> heard = [&connections, place] { connections.heard_of(place); };
  try {
    co_await answer_requests(stream, answer, heard);
  } catch (const std::exception&) {  // gone or too slow: nothing is owed, and the others go on
  }
  connections.close(place);
  beast::error_code ignored;
  stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
}

/// Takes connections as long as the program runs, whatever fails in between.
asio::awaitable<void> welcome(tcp::acceptor& acceptor, Connections& connections, const Answering& answer) {
  constexpr std::chrono::milliseconds pause{50};
  for (;;) {
    beast::error_code error;
    tcp::socket socket = co_await acceptor.async_accept(asio::redirect_error(asio::use_awaitable, error));
    if (!error) {
      asio::co_spawn(acceptor.get_executor(), converse(beast::tcp_stream(std::move(socket)), connections, answer),
                     asio::detached);
      continue;
    }
    connections.close_oldest();  // no descriptor is left, as a rule
    asio::steady_timer timer(acceptor.get_executor(), pause);
    co_await timer.async_wait(asio::redirect_error(asio::use_awaitable, error));
  }
}

tcp::acceptor listen(asio::io_context& context, unsigned short port) {
  try {
    return {context, {asio::ip::address_v4::loopback(), port}};
  } catch (const boost::system::system_error& error) {
    throw InputError(fmt::format(
        "port {} can't be had: {}\n  hint: --port 0 takes any free one; is another soilbin serve still running?", port,
        error.code().message()));
  }
}

/// Ends the service soon after Ctrl-C (cli/progress.hpp), by which an answer under way is given up as well.
asio::awaitable<void> stop_when_asked(asio::io_context& context) {
  constexpr std::chrono::milliseconds between_looks{100};
  asio::steady_timer timer(context);
  while (!interrupt_asked()) {
    timer.expires_after(between_looks);
    co_await timer.async_wait(asio::use_awaitable);
  }
  context.stop();
}

}  // namespace

void serve_http(unsigned short port, const std::function<void(const std::string& address)>& listening,
                const Answering& answer) {
  asio::io_context context(1);
  tcp::acceptor acceptor = listen(context, port);
  asio::co_spawn(context, stop_when_asked(context), asio::detached);
  Connections connections;
  asio::co_spawn(context, welcome(acceptor, connections, answer), asio::detached);
  listening(fmt::format("http://127.0.0.1:{}/", acceptor.local_endpoint().port()));
  context.run();
}

}  // namespace soilbin::cli
