#include "cli/serve/server.hpp"

#include <fmt/core.h>

#include <boost/asio/awaitable.hpp>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>

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

bool names_this_machine(beast::string_view host) {
  const beast::string_view name = host.substr(0, host.rfind(':'));
  return name == "127.0.0.1" || name == "localhost";
}

Reply reply_to_request(const Request& request, const Answering& answer) {
  if (!names_this_machine(request[http::field::host]))
    return refusal(403, "this server answers its own machine only\n  hint: open the address that it printed");
  if (request.method() != http::verb::get && request.method() != http::verb::head)
    return refusal(405, "only GET is answered");
  const beast::string_view target = request.target();
  try {
    return answer({target.data(), target.size()});
  } catch (const std::exception& error) {
    return refusal(500, error.what());
  }
}

Response respond(const Request& request, const Answering& answer) {
  Reply reply = reply_to_request(request, answer);
  Response response(static_cast<http::status>(reply.status), request.version());
  response.set(http::field::content_type, reply.type);
  response.set(http::field::cache_control, "no-store");
  response.set("X-Content-Type-Options", "nosniff");
  response.keep_alive(request.keep_alive());
  response.content_length(reply.body.size());
  if (request.method() != http::verb::head) response.body() = std::move(reply.body);
  return response;
}

/// One connection, to its end.
asio::awaitable<void> converse(beast::tcp_stream stream, const Answering& answer) {
  beast::flat_buffer buffer;
  try {
    for (bool more = true; more;) {
      stream.expires_after(patience);
      http::request_parser<http::string_body> parser;
      parser.body_limit(largest_body);
      co_await http::async_read(stream, buffer, parser, asio::use_awaitable);
      const Response response = respond(parser.get(), answer);
      co_await http::async_write(stream, response, asio::use_awaitable);
      more = response.keep_alive();
    }
  } catch (const boost::system::system_error&) {  // gone, too slow, or no HTTP: nothing is owed
  }
  beast::error_code ignored;
  stream.socket().shutdown(tcp::socket::shutdown_send, ignored);
}

asio::awaitable<void> welcome(tcp::acceptor& acceptor, const Answering& answer) {
  for (;;) {
    tcp::socket socket = co_await acceptor.async_accept(asio::use_awaitable);
    asio::co_spawn(acceptor.get_executor(), converse(beast::tcp_stream(std::move(socket)), answer), asio::detached);
  }
}

tcp::acceptor listen(asio::io_context& context, unsigned short port) {
  try {
    return {context, {asio::ip::address_v4::loopback(), port}};
  } catch (const boost::system::system_error& error) {
    throw InputError(
        fmt::format("port {} can't be had: {}\n  hint: --port 0 takes any free one; is another soilbin serve "
                    "still running?",
                    port, error.code().message()));
  }
}

}  // namespace

void serve_http(unsigned short port, const std::function<void(const std::string& address)>& listening,
                const Answering& answer) {
  asio::io_context context(1);
  tcp::acceptor acceptor = listen(context, port);
  asio::signal_set signals(context, SIGINT, SIGTERM);
  signals.async_wait([&](const boost::system::error_code&, int) { context.stop(); });
  asio::co_spawn(context, welcome(acceptor, answer), asio::detached);
  listening(fmt::format("http://127.0.0.1:{}/", acceptor.local_endpoint().port()));
  context.run();
}

}  // namespace soilbin::cli
