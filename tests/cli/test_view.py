"""wilt view: the studio's page on loopback. The program is run from a folder of its own with a small page beside it.

Oracles: the bytes of the files; types of the MIME registry; HTTP requests that no browser would send, written by hand.
"""
import http.client
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import unittest

import voice

WILT = sys.argv.pop(1)
TYPES = {"index.html": "text/html", "assets/app-1a2b.js": "text/javascript", "assets/core.mjs": "text/javascript",
         "assets/wilt.wasm": "application/wasm", "assets/page.css": "text/css", "icon.svg": "image/svg+xml",
         "a name with spaces.json": "application/json", "strange": "application/octet-stream"}


class View(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory(prefix="wilt-view-")
        cls.dir = pathlib.Path(cls.folder.name)
        cls.wilt = cls.dir / "bin" / "wilt"
        cls.wilt.parent.mkdir()
        shutil.copy(WILT, cls.wilt)
        cls.page = cls.dir / "share" / "wilt" / "studio"
        (cls.page / "assets").mkdir(parents=True)
        for name in TYPES:
            (cls.page / name).write_bytes(name.encode() * 70000 + bytes(range(256)))
        (cls.dir / "secret.txt").write_text("top secret")
        (cls.page / "link.txt").symlink_to(cls.dir / "secret.txt")
        (cls.page / "linked").symlink_to(cls.dir)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def serve(self, *arguments):
        """A server that ends with the test: (process, first line of stdout)."""
        server = subprocess.Popen([self.wilt, "view", "--no-browser", *map(str, arguments)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, text=True, cwd=self.dir)
        self.addCleanup(lambda: (server.kill(), server.communicate()))
        return server, server.stdout.readline().strip()

    def start(self, *arguments):
        self.server, line = self.serve("--json", *arguments)
        facts = json.loads(line)
        self.port, self.url = facts["port"], facts["url"]
        self.assertTrue(self.url.startswith(f"http://127.0.0.1:{self.port}/"), self.url)

    def get(self, path, method="GET", headers=None):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=20)
        connection.request(method, path, headers=headers or {})
        answer = connection.getresponse()
        body = answer.read()
        connection.close()
        return answer, body

    def raw(self, text):
        with socket.create_connection(("127.0.0.1", self.port), timeout=20) as stream:
            stream.sendall(text.encode("latin-1"))
            answer = b""
            try:
                while part := stream.recv(65536):
                    answer += part
            except ConnectionResetError:
                pass  # it did not read all of it
        return answer

    def refused(self, *arguments, code, says):
        result = subprocess.run([self.wilt, "view", "--no-browser", *map(str, arguments)], capture_output=True, text=True,
                                timeout=60, cwd=self.dir)
        self.assertEqual(result.returncode, code, result.stderr)
        self.assertIn(says, result.stderr)
        self.assertEqual((voice.faults(result.stderr), result.stdout), ([], ""))

    def test_files_are_given_byte_for_byte_with_their_types(self):
        self.start()
        self.assertEqual(self.url, f"http://127.0.0.1:{self.port}/")
        for name, kind in TYPES.items():
            answer, body = self.get("/" + name.replace(" ", "%20"), headers={"Accept-Encoding": "gzip, br"})
            self.assertEqual((answer.status, answer.headers.get_content_type()), (200, kind), name)
            self.assertEqual(body, (self.page / name).read_bytes(), name)
            self.assertEqual(answer.headers["X-Content-Type-Options"], "nosniff")
            self.assertEqual("immutable" in answer.headers["Cache-Control"], name.startswith("assets/"), name)
        self.assertEqual(self.get("/")[1], (self.page / "index.html").read_bytes())
        self.assertEqual(self.get("/?x=1")[1], (self.page / "index.html").read_bytes())
        answer, body = self.get("/assets/wilt.wasm", "HEAD")
        self.assertEqual((answer.status, body), (200, b""))
        self.assertEqual(int(answer.headers["Content-Length"]), (self.page / "assets/wilt.wasm").stat().st_size)
        answer, body = self.get("/strange", headers={"Range": "bytes=3-9"})
        self.assertEqual((answer.status, body), (206, (self.page / "strange").read_bytes()[3:10]))

    def test_nothing_else_is_given(self):
        self.start()
        for path in ("/nothing", "/assets", "/assets/", "/..", "/../secret.txt", "/../../../secret.txt", "/%2e%2e/%2e%2e/%2e%2e/secret.txt",
                     "/..%2f..%2f..%2fsecret.txt", "/assets/../index.html", "//index.html", "/./index.html", "/link.txt",
                     "/linked/secret.txt", "/index.html/", "/index.html%00", "/leaf/", "/leaf/index.html", "/etc/passwd",
                     str(self.dir / "secret.txt"), "/%5c..%5csecret.txt", "/" + "a" * 5000):
            answer, body = self.get(path)
            self.assertEqual(answer.status, 404, path)
            self.assertNotIn(b"top secret", body)
        for text in ("GET ../secret.txt HTTP/1.0\r\nHost: 127.0.0.1\r\n\r\n", "GET\r\n\r\n", "x" * 100000 + "\r\n\r\n",
                     f"GET http://127.0.0.1:{self.port}/../secret.txt HTTP/1.0\r\nHost: 127.0.0.1:{self.port}\r\n\r\n"):
            self.assertNotIn(b"top secret", self.raw(text))
        for method in ("POST", "PUT", "DELETE", "OPTIONS"):
            self.assertEqual(self.get("/", method)[0].status, 405, method)
        self.assertEqual(self.get("/")[0].status, 200)

    def test_only_who_asks_for_this_machine_is_answered(self):
        """DNS rebinding: a foreign page whose host name points here says its own name."""
        self.start()
        for host in ("evil.example", f"evil.example:{self.port}", "127.0.0.1", f"127.0.0.1:{self.port + 1}", "",
                     f"127.0.0.1.evil.example:{self.port}", f"evil@127.0.0.1:{self.port}"):
            answer, body = self.get("/", headers={"Host": host})
            self.assertEqual(answer.status, 403, host)
            self.assertNotIn(b"index", body)
        self.assertIn(b" 403 ", self.raw("GET / HTTP/1.0\r\n\r\n").split(b"\r\n")[0])
        self.assertEqual(self.get("/", headers={"Host": f"localhost:{self.port}"})[0].status, 200)
        with self.assertRaises(OSError):  # loopback alone: another address of this machine does not answer
            socket.create_connection(("127.0.0.2", self.port), timeout=5).close()

    def test_one_leaf_is_given_beside_the_page(self):
        leaf = self.dir / "my leaf #1 \u00e4.svg"
        leaf.write_text("<svg/>")
        self.start(leaf)
        address, fragment = self.url.split("#")
        self.assertEqual(fragment, "file=my%20leaf%20%231%20%C3%A4.svg")
        answer, body = self.get("/leaf/" + fragment.removeprefix("file="))
        self.assertEqual((answer.status, body, answer.headers["Cache-Control"]), (200, b"<svg/>", "no-store"))
        leaf.write_text("<svg></svg>")
        self.assertEqual(self.get("/leaf/" + fragment.removeprefix("file="))[1], b"<svg></svg>")
        leaf.unlink()
        self.assertEqual(self.get("/leaf/" + fragment.removeprefix("file="))[0].status, 404)
        self.assertEqual(self.get("/leaf/secret.txt")[0].status, 404)

    def test_a_species_is_named(self):
        self.start("ivy")
        self.assertTrue(self.url.endswith("/#species=ivy"))

    def test_the_address_is_printed_and_ctrl_c_ends_with_130(self):
        for which in (signal.SIGINT, signal.SIGTERM):
            server, line = self.serve()
            self.assertRegex(line, r"^http://127\.0\.0\.1:\d+/$")
            with socket.create_connection(("127.0.0.1", int(line.split(":")[2].strip("/"))), timeout=20):  # one who stays
                server.send_signal(which)
                out, messages = server.communicate(timeout=30)
            self.assertEqual((server.returncode, out), (130, ""))
            self.assertEqual(voice.faults(messages), [])

    def test_a_port_may_be_chosen_and_is_not_shared(self):
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        self.start("--port", port)
        self.assertEqual(self.port, port)
        self.refused("--port", port, code=5, says=f"port {port}")
        self.refused("--port", "70000", code=2, says="0 to 65535")

    def test_a_leaf_that_cannot_be_used_is_refused_before_anything_is_served(self):
        (self.dir / "points.xyz").write_text("0 0 0\n")
        locked = self.dir / "locked.svg"
        locked.write_text("<svg/>")
        locked.chmod(0)
        self.refused("mapel", code=3, says="did you mean 'maple'?")
        self.refused("none.svg", code=3, says="none.svg")
        self.refused(".", code=3, says="a folder")
        self.refused("points.xyz", code=3, says="the page takes .obj")
        if os.getuid() != 0:
            self.refused(locked, code=3, says="permissions")

    def test_a_page_that_was_not_built_is_said(self):
        alone = self.dir / "alone" / "bin" / "wilt"
        alone.parent.mkdir(parents=True)
        os.link(self.wilt, alone)
        result = subprocess.run([alone, "view", "--no-browser"], capture_output=True, text=True, timeout=60)
        self.assertEqual(result.returncode, 3, result.stderr)
        self.assertIn("scripts/build-studio", result.stderr)
        self.assertEqual(voice.faults(result.stderr), [])

    def test_a_browser_is_opened_where_there_is_a_display(self):
        opener = self.dir / "opener" / "xdg-open"
        opener.parent.mkdir(exist_ok=True)
        opener.write_text(f"#!/bin/sh\necho \"$@\" > {self.dir}/opened.tmp\nmv {self.dir}/opened.tmp {self.dir}/opened\n")
        opener.chmod(0o755)
        without = {key: value for key, value in os.environ.items() if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        for display, opened in (({"DISPLAY": ":0"}, True), ({}, False)):
            environment = without | {"PATH": f"{opener.parent}:{os.environ['PATH']}"} | display
            server = subprocess.Popen([self.wilt, "view", "maple"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                                      env=environment)
            address = server.stdout.readline().strip()
            said = [server.stderr.readline() for _ in range(1 if opened else 2)]
            while opened and not (self.dir / "opened").exists():
                self.assertIsNone(server.poll())
            server.send_signal(signal.SIGINT)
            server.communicate(timeout=30)
            if opened:
                self.assertEqual((self.dir / "opened").read_text().strip(), address)
            else:
                self.assertIn("open the address yourself", said[1])


if __name__ == "__main__":
    unittest.main()
