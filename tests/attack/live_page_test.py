"""What floods, rubbish and other hosts do to the live page."""
import http.client
import socket
import unittest

from attack import Attack, limited


class TheLivePage(Attack):
    def setUp(self):
        super().setUp()
        self.process = None

    def serve(self, **more):
        self.process = self.start("serve", "--port", "0", "paper-straight", "--load", "4kN", **more)
        self.port = int(self.process.stdout.readline().strip().rstrip("/").rsplit(":", 1)[1])

    def ask(self, target, method="GET", body=None, **headers):
        line = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        line.request(method, target, body=body, headers=headers)
        answer = line.getresponse()
        text = answer.read().decode()
        line.close()
        return answer.status, text

    def raw(self, sent):
        """The first line that comes back for these bytes."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=10) as line:
            line.sendall(sent)
            return line.makefile("rb").readline().decode()

    def test_answers_while_others_hold_every_connection_that_it_has(self):
        self.serve(preexec_fn=limited(NOFILE=40))
        held = []
        for _ in range(200):
            held.append(socket.create_connection(("127.0.0.1", self.port), timeout=10))
        self.assertEqual(self.ask("/case")[0], 200)
        for line in held:
            line.close()
        self.assertEqual(self.ask("/case")[0], 200)

    def test_answers_after_1100_connections(self):
        self.serve()
        for _ in range(1100):
            socket.create_connection(("127.0.0.1", self.port), timeout=10).close()
        self.assertEqual(self.ask("/case")[0], 200)

    def test_says_what_is_wrong_with_a_request(self):
        self.serve()
        self.assertIn(" 414 ", self.raw(b"GET /estimate?" + b"a" * 9000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n"))
        self.assertIn(" 414 ", self.raw(b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"a" * 100000 + b"\r\n\r\n"))
        self.assertIn(" 400 ", self.raw(b"rubbish\r\n\r\n"))
        self.assertIn(" 400 ", self.raw(b"\x00\xff\x16\x03\x01 / \r\n\r\n"))
        self.assertIn(" 413 ", self.raw(b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 100000\r\n\r\n" + b"a" * 100000))
        self.assertEqual(self.ask("/case")[0], 200)

    def test_tiny_numbers_are_numbers(self):
        self.serve()
        for load in ("1e-320N", "1e-308N", "4.9e-324N"):
            status, text = self.ask(f"/estimate?load={load}")
            self.assertIn(status, (200, 400, 422), text)
            self.assertNotIn("stod", text)

    def test_another_host_is_refused_however_it_is_spelt(self):
        self.serve()
        for host in ("127.0.0.1:evil.com", "localhost.evil.com", "localhost:80:evil", "evil.com:127.0.0.1", ""):
            self.assertEqual(self.ask("/case", Host=host)[0], 403, host)
        for host in (f"127.0.0.1:{self.port}", "localhost"):
            self.assertEqual(self.ask("/case", Host=host)[0], 200, host)


if __name__ == "__main__":
    unittest.main(verbosity=1)
