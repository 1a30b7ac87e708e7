"""`soilbin serve` at a free port, for the tests of what it answers and of its page. First argument: the command's path."""
import http.client
import json
import os
import signal
import subprocess
import sys
from urllib.parse import quote

SOILBIN = sys.argv.pop(1)


class Server:
    """`soilbin serve WORDS` at a free port."""

    def __init__(self, *words, **environment):
        self.process = subprocess.Popen([SOILBIN, "serve", "--port", "0", *words], stdout=subprocess.PIPE, text=True,
                                        stderr=subprocess.PIPE, env=os.environ | environment)
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), self.process.communicate()
        self.port = int(self.address.rstrip("/").rsplit(":", 1)[1])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.stop()

    def stop(self, how=signal.SIGINT):
        if self.process.poll() is None:
            self.process.send_signal(how)
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out, err

    def ask(self, target, method="GET", **headers):
        """Status, headers and text of a target."""
        line = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        line.request(method, target, headers=headers)
        answer = line.getresponse()
        text = answer.read().decode()
        line.close()
        return answer.status, answer.headers, text

    def estimate(self, **flags):
        return self.answer("/estimate", **flags)

    def answer(self, path, **flags):
        """Status and document; a flag that is given as a list is given again and again."""
        pairs = [(key, one) for key, value in flags.items() for one in (value if isinstance(value, list) else [value])]
        status, _, text = self.ask(f"{path}?" + "&".join(f"{k.replace('_', '-')}={quote(v)}" for k, v in pairs))
        return status, json.loads(text)


def soilbin(*words, **more):
    return subprocess.run([SOILBIN, *words], capture_output=True, text=True, check=False, **more)
