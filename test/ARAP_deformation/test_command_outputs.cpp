// Copyright (c) 2026  The ARAP_deformation authors.
// All rights reserved.
//
// This file is part of CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later OR LicenseRef-Commercial
//
// Author(s)     : The ARAP_deformation authors

// The command arap_deform with pipes, devices, links, what the shell has opened, and signals: it
// does not hang, and whatever fails, all files are as they were. The path of the command is the
// argument; without it nothing is tested.

#include "include/check.h"
#include "include/command.h"

#include <cstdlib>
#include <iostream>
#include <string>

const std::string mesh = "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
const std::string call = "arap in.off --selection in.sel -o in.off ";

// Runs a line of the shell in which arap stands for the command, and returns the exit code of that.
// `limit` says how it is ended if it takes too long.
Run run_arap(const std::string& line, const std::string& limit = "-s KILL 20")
{
  test_case() = line;
  write("in.off", mesh);
  Run result = run_line("arap() { timeout " + limit + " \"" + command +
                        "\" \"$@\" --transform in.def --threads 1; echo $? > status; }; " + line);
  const std::string status = content(folder / "status");
  result.exit_code = status.empty() ? -1 : std::stoi(status);
  fs::remove(folder / "status");
  return result;
}

bool is_deformed() { return content(folder / "in.off") != mesh; }

void check_done(const Run& done)
{
  if(!CHECK(done.exit_code == 0 && is_deformed()))
    std::cerr << "    exit code " << done.exit_code << ", the message was: " << done.err;
}

void check_failed(const std::string& line, int exit_code, const std::string& phrase,
                  const std::string& limit = "-s KILL 20")
{
  const auto before = files();
  const Run failed = run_arap(line, limit);
  if(!CHECK(failed.exit_code == exit_code && failed.err.find(phrase) != std::string::npos))
    std::cerr << "    exit code " << failed.exit_code << ", the message was: " << failed.err;
  CHECK(!is_deformed());
  CHECK(files() == before);
}

bool is_report(const std::string& text)
{
  return text.substr(0, 2) == "{\n" && text.substr(text.size() - 2) == "}\n";
}

void test_pipes()
{
  Run done = run_arap(call + "--quiet --report /dev/stdout | cat");
  check_done(done);
  CHECK(is_report(done.out));
  done = run_arap("cat in.sel | arap in.off --selection /dev/stdin -o in.off --quiet "
                  "--report /dev/stdout | cat");
  check_done(done);
  CHECK(is_report(done.out));
  check_done(run_arap("timeout 20 cat fifo > got & " + call + "--report fifo; wait"));
  CHECK(is_report(content(folder / "got")));
  fs::remove(folder / "got");
  check_failed("{ sleep 0.1; " + call + "--quiet --report /dev/stdout; } | true", 1,
               "/dev/stdout: could not be written to the end");
  check_failed("{ sleep 0.1; " + call + "; } | true", 1, "the standard output could not be");
  check_failed(call + "> /dev/full", 1, "the standard output could not be written");
  check_failed(call + "--report /dev/full", 1, "/dev/full: could not be written to the end");
  check_failed("arap fifo.off --selection in.sel -o in.off", 1, "fifo.off: is not a regular file");
}

// What the shell has opened goes on from where it is.
void test_descriptors()
{
  const auto check_log = [](const std::string& line, const std::string& start) {
    write("log", "old\n");
    const Run done = run_arap(line);
    check_done(done);
    const std::string log = content(folder / "log");
    CHECK(log.substr(0, start.size()) == start);
    CHECK((log + done.out).find("}\nin.off: 4 vertices") != std::string::npos);
    CHECK((log + done.out).find("written: in.off") != std::string::npos);
  };
  check_log(call + "--report /dev/stdout >> log", "old\n{\n");
  check_log(call + "--report /dev/stdout > log", "{\n");
  check_log(call + "--report /dev/stderr 2>> log", "old\n{\n");
  check_log(call + "--report /dev/fd/3 3>> log", "old\n{\n");
  check_log(call + "--report /proc/self/fd/3 3> log", "{\n");
  check_log(call + "--report link_to_stdout >> log", "old\n{\n");
  CHECK(fs::is_symlink(folder / "link_to_stdout"));
  fs::remove(folder / "log");

  check_failed(call + "--report /dev/fd/9", 1, "/dev/fd/9: cannot be written");
  check_failed(call + "--report /dev/fd/3 3< in.def", 2, "is given for two things");
  check_failed(call + "--report /dev/stdout >> in.sel", 2, "is given for two things");
  check_failed("arap in.off --selection in.sel -o new.off --report \"$PWD/new.off\"", 2,
               "is given for two things");
}

void test_names()
{
  const auto check_new = [](const std::string& name, const std::string& written) {
    CHECK(run_arap("arap in.off --selection in.sel -o " + name).exit_code == 0);
    CHECK(content(folder / written).substr(0, 3) == "OFF");
    fs::remove(folder / written);
  };
  fs::create_symlink("new.off", folder / "dangling.off");
  check_new("dangling.off", "new.off");
  CHECK(fs::is_symlink(folder / "dangling.off"));
  const std::string longest = std::string(251, 'x') + ".off";
  check_new(longest, longest);
  fs::create_symlink("circle.off", folder / "circle.off");
  check_failed("arap in.off --selection in.sel -o circle.off", 1, "circle.off: cannot be written");
}

// timeout returns 124 for what its signal has ended, and 137 for what it had to kill.
void test_signals()
{
  for(const std::string signal : {"TERM", "HUP"})
  {
    const std::string limit = "-s " + signal + " -k 5 0.2";
    check_failed(call + "--report fifo", 124, "", limit);
    check_failed("arap in.off --selection fifo -o in.off", 124, "", limit);
    check_failed(call + "--iterations 100000000 --tolerance 0", 124, "", limit);
  }
  // a pipe that nobody reads, and which is full before the end of the report
  check_failed("timeout 1 sh -c 'sleep 1 < fifo' & " + call +
               "--iterations 20000 --tolerance 0 --report fifo", 124, "", "-s TERM -k 5 0.4");
}

int main(int argc, char** argv)
{
#if !defined(__linux__)
  std::cout << "NOTICE: pipes, devices and signals are tested on Linux only; nothing was tested."
            << std::endl;
  return EXIT_SUCCESS;
#endif
  return test_command(argc, argv, [] {
    write("in.sel", "0\n0\n1\n2\n");
    write("in.def", "1 0 0 0.1\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
    fs::create_symlink("/dev/stdout", folder / "link_to_stdout");
    CHECK(run_line("mkfifo fifo fifo.off").exit_code == 0);
    test_pipes();
    test_descriptors();
    test_names();
    test_signals();
  });
}
