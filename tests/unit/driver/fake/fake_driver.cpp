// A driver that misbehaves as it is told: its argument names a file that holds a fault and the request that it strikes
// ("nan move"), read again before each answer. Without a fault it is an ideal scanner of a wall 1 m away. What follows
// are its abilities, and "for-ever" if it is to be waited for.
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <map>
#include <string>
#include <thread>

namespace {

constexpr int width = 4, height = 3;
const std::string identity = "[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";

void say(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t sent = ::write(STDOUT_FILENO, text.data() + at, text.size() - at);
    if (sent <= 0) ::_exit(9);
    at += static_cast<std::size_t>(sent);
  }
}

[[noreturn]] void sleep_for_ever() {
  for (;;) ::pause();
}

/// What follows `"key":` in a request, up to the end of the number, text or list of numbers.
std::string value(const std::string& line, const std::string& key) {
  std::size_t begin = line.find("\"" + key + "\":");
  if (begin == line.npos) return {};
  begin += key.size() + 3;
  if (line[begin] == '"') return line.substr(begin + 1, line.find('"', begin + 1) - begin - 1);
  if (line[begin] == '[') return line.substr(begin, line.find(']', begin) - begin + 1);
  return line.substr(begin, line.find_first_of(",}", begin) - begin);
}

std::size_t count_poses(const std::string& line) {
  std::size_t count = 0;
  for (std::size_t at = line.find("\"poses\":"); (at = line.find(']', at + 1)) != line.npos;) ++count;
  return count - 1;
}

/// Ranges of 1 m, and a fault in them.
void write_capture(const std::string& file, const std::string& fault) {
  const int rows = fault == "wrong_size" ? height + 1 : height;
  std::string header = "{'descr': '" + std::string(fault == "whole_numbers" ? "<i8" : "<f4") +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(rows) + ", " + std::to_string(width) +
                       "), }";
  header.resize(117, ' ');
  header += '\n';
  std::ofstream out(file, std::ios::binary);
  out << "\x93NUMPY\x01" << '\0' << char(header.size()) << '\0' << header;
  const float range = fault == "negative" ? -1.0f : fault == "all_nan" ? std::nanf("") : 1.0f;
  for (int i = 0; i < rows * width - (fault == "short_file" ? 1 : 0); ++i)
    out.write(reinterpret_cast<const char*>(&range), sizeof(range));
}

std::string pose = identity, abilities;
bool waits = false;

std::string hello(const std::string& fault) {
  const std::string edge = fault == "wrong_size" ? "-4" : std::to_string(width);
  return "\"protocol\":" + std::string(fault == "version" ? "2" : "1") + ",\"name\":\"fake\",\"abilities\":[" +
         abilities + "],\"intrinsics\":[4,4,1.5,1],\"width\":" + edge + ",\"height\":" + std::to_string(height) +
         ",\"max_range\":" +
         (fault == "nan"       ? "NaN"
          : fault == "null"    ? "null"
          : fault == "another" ? "3"
                               : "2") +
         ",\"range_noise\":0.001" + (fault == "object" ? ",\"object\":\"box\"" : "") + (waits ? ",\"timeout\":0" : "");
}

std::string reach(const std::string& line, const std::string& fault) {
  std::string list;
  const std::size_t count = count_poses(line) + (fault == "wrong_size" ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i)
    list += std::string(i ? "," : "") + "{\"distance\":" + (fault == "negative" ? "-1" : "1") + ",\"rotation\":" +
            (fault == "nan"    ? "NaN"
             : fault == "null" ? "null"
                               : "0") +
            ",\"seconds\":2}";
  return "\"reach\":[" + list + "]";
}

std::string pose_with(const std::string& fault) {
  if (fault == "nan") return "\"pose\":[NaN" + identity.substr(2);
  if (fault == "null") return "\"pose\":[null" + identity.substr(2);
  if (fault == "wrong_type") return "\"pose\":\"here\"";
  if (fault == "not_rigid") return "\"pose\":[2,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]";
  if (fault == "few") return "\"pose\":[1,0,0]";
  if (fault == "far") return "\"pose\":[1,0,0,7,0,1,0,0,0,0,1,0,0,0,0,1]";
  if (fault == "none_said") return "\"where\":1";
  return "\"pose\":" + pose;
}

std::string capture(const std::string& line, const std::string& fault) {
  const std::string name = fault == "missing_file" ? "missing.npy" : fault == "folder" ? "." : "capture.npy";
  if (name == "capture.npy") write_capture(value(line, "folder") + "/" + name, fault);
  return pose_with(fault) + ",\"file\":\"" + name + "\"";
}

std::string body(const std::string& request, const std::string& line, const std::string& fault) {
  if (request == "hello") return hello(fault);
  if (request == "reach") return reach(line, fault);
  if (request == "capture") return capture(line, fault);
  if (request == "move") pose = value(line, "pose");
  return request == "move" ? pose_with(fault) : "\"done\":true";
}

/// Faults that are the same whatever was asked. Returns whether it was one, and no answer is to follow.
bool strikes(const std::string& fault, const std::string& id) {
  if (fault == "die") ::_exit(3);
  if (fault == "killed") ::raise(SIGKILL);
  if (fault == "complain") std::cerr << "first line\nthe arm is not switched on\n" << std::flush, ::_exit(4);
  if (fault == "garbage") return say("hello, world\n"), true;
  if (fault == "no_id") return say("{\"ok\":true}\n"), true;
  if (fault == "list") return say("[1,2,3]\n"), true;
  if (fault == "wrong_id") return say("{\"id\":123456,\"ok\":true}\n"), true;
  if (fault == "neither") return say("{\"id\":" + id + "}\n"), true;
  if (fault == "error") return say("{\"id\":" + id + ",\"error\":\"the arm is\\njammed\"}\n"), true;
  if (fault == "odd_error") return say("{\"id\":" + id + ",\"error\":7}\n"), true;
  if (fault == "partial") return say("{\"id\":" + id + ",\"ok\":tr"), true;
  if (fault == "partial_die") say("{\"id\":" + id), ::_exit(0);
  if (fault == "close") return ::close(STDOUT_FILENO), ::close(STDIN_FILENO), sleep_for_ever(), true;
  if (fault == "stubborn") return ::signal(SIGTERM, SIG_IGN), sleep_for_ever(), true;
  if (fault == "flood")
    for (;;) say("{\"id\":1,\"ok\":true}\n");
  if (fault == "huge")
    for (const std::string part(1 << 20, 'x');;) say(part);
  return fault == "silence";
}

}  // namespace

int main(int count, char** arguments) {
  for (int i = 2; i < count; ++i)
    if (arguments[i] == std::string("for-ever"))
      waits = true;
    else
      abilities += std::string(abilities.empty() ? "" : ",") + '"' + arguments[i] + '"';
  for (std::string line; std::getline(std::cin, line);) {
    const std::string request = value(line, "request"), id = value(line, "id");
    std::string fault, at;
    std::ifstream(arguments[1]) >> fault >> at;
    if (at != request) fault.clear();
    if (request == "bye") return 0;
    if (fault == "late") std::this_thread::sleep_for(std::chrono::milliseconds(800));
    if (fault == "slow") {  // until it is told to stop
      std::getline(std::cin, line);
      say("{\"id\":" + id + ",\"error\":\"stopped\"}\n{\"id\":" + value(line, "id") + ",\"ok\":true}\n");
      continue;
    }
    if (strikes(fault, id)) continue;
    say("{\"id\":" + id + ",\"ok\":true," + body(request, line, fault) + "}\n");
  }
}
