// SPDX-License-Identifier: BSD-3-Clause
#include "answer.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <system_error>
#include <vector>

#include "rondo/core/error.hpp"
#include "rondo/core/version.hpp"
#include "rondo/output/run_files.hpp"
#include "rondo/study/sweep/worker_processes.hpp"
#include "signals.hpp"

namespace rondo::app {
namespace {

struct Kept {
  std::string command;
  std::vector<std::string> warnings, errors;
  std::vector<Fault> faults;
};

Kept& kept() {
  static Kept instance;
  return instance;
}

class KeepingSink : public spdlog::sinks::base_sink<std::mutex> {
  void sink_it_(const spdlog::details::log_msg& message) override {
    const std::string text(message.payload.begin(), message.payload.end());
    if (message.level == spdlog::level::warn) kept().warnings.push_back(text);
    if (message.level == spdlog::level::err) kept().errors.push_back(text);
  }
  void flush_() override {}
};

struct Status {
  int code;
  std::string_view name;
};

constexpr Status statuses[] = {{exit_done, "done"},
                               {exit_input, "wrong-input"},
                               {exit_numerical, "numerical-failure"},
                               {exit_files, "file-failure"},
                               {exit_interrupted, "interrupted"}};

std::string_view name_of(int code) {
  const auto found = std::ranges::find(statuses, code, &Status::code);
  return found == std::end(statuses) ? "numerical-failure" : found->name;
}

Json text_or_null(const std::string& text) {
  return text.empty() ? Json() : Json(text);
}

Json number_or_null(int number) {
  return number > 0 ? Json(number) : Json();
}

struct FaultMember {
  const char* name;
  const char* type;
  const char* meaning;
  Json (*value)(const Fault& fault);
};

constexpr FaultMember fault_members[] = {
    {"file", "string", "that it is in; of the command line the option or --set",
     [](const Fault& f) { return text_or_null(f.file); }},
    {"line", "integer", "from 1", [](const Fault& f) { return number_or_null(f.line); }},
    {"column", "integer", "from 1, in characters",
     [](const Fault& f) { return number_or_null(f.column); }},
    {"key", "string", "dotted, tables of lists by number from 0",
     [](const Fault& f) { return text_or_null(f.key); }},
    {"found", "string", "as it is written", [](const Fault& f) { return text_or_null(f.found); }},
    {"message", "string", "what is wrong", [](const Fault& f) { return text_or_null(f.message); }},
    {"allowed", "string", "what is allowed, or what to do",
     [](const Fault& f) { return text_or_null(f.allowed); }},
};

Json faults_of(const std::vector<Fault>& faults) {
  Json array = Json::array();
  for (const Fault& fault : faults) {
    Json object;
    for (const FaultMember& member : fault_members) object[member.name] = member.value(fault);
    array.push_back(std::move(object));
  }
  return array;
}

Json fault_schema() {
  Json schema = study::closed_object();
  for (const FaultMember& member : fault_members) {
    schema["properties"][member.name] = {{"type", {member.type, "null"}},
                                         {"description", member.meaning}};
    schema["required"].push_back(member.name);
  }
  return schema;
}

std::string document(const Json& result, int code, const Kept& told) {
  std::string message;
  for (const std::string& error : told.errors) message += (message.empty() ? "" : "\n") + error;
  Json json;
  json["command"] = told.command;
  json["version"] = version;
  json["build_record"] = study::build_record_json();
  json["status"] = name_of(code);
  json["exit_code"] = code;
  json["message"] = text_or_null(message);
  json["faults"] = faults_of(told.faults);
  json["warnings"] = told.warnings;
  json["result"] = result;
  constexpr int indent = 2;
  try {
    return json.dump(indent) + "\n";
  } catch (const Json::type_error&) {  // the name of a file or folder is not UTF-8
    json["warnings"].push_back(
        "a name in this document is not UTF-8, which JSON cannot hold: U+FFFD stands there for the "
        "bytes that are none, and nothing is found by that name; take a name in UTF-8");
    return json.dump(indent, ' ', false, Json::error_handler_t::replace) + "\n";
  }
}

}  // namespace

bool is_json_asked_for(int argc, char** argv) {
  return std::any_of(argv + 1, argv + std::max(argc, 1),
                     [](const char* argument) { return std::string_view(argument) == "--json"; });
}

void begin_answer(const std::string& command) {
  kept().command = command;
  spdlog::default_logger()->sinks().push_back(std::make_shared<KeepingSink>());
  say_at_stop_signals(document({}, exit_interrupted, {command, {}, {"interrupted"}, {}}));
}

int tell_failure(const std::exception& error) {
  if (const auto* wrong = dynamic_cast<const InputError*>(&error)) {
    kept().faults = wrong->faults();
    for (const Fault& fault : wrong->faults()) spdlog::error("{}", fault.text());
    if (wrong->faults().size() > 1)
      spdlog::error("{} errors; nothing was run", wrong->faults().size());
    return exit_input;
  }
  if (dynamic_cast<const std::system_error*>(&error)) {  // from printing; files throw FileError
    spdlog::error("standard output: {}", error.what());
    return exit_files;
  }
  const study::WorkerOutcome failed = study::failed_by(error);
  spdlog::error("{}", failed.text);
  return failed.code;
}

void warn_of_end(Telling& tell, const std::string& text) {
  tell.end = text;
  spdlog::warn("{}", text);
}

void print_answer(const Telling& tell, int code) {
  say_at_stop_signals({});
  Kept told = kept();
  if (told.errors.empty() && !tell.end.empty()) told.errors.push_back(tell.end);
  fmt::print("{}", document(tell.result, code, told));
}

Json answer_schema(std::string_view command, Json result) {
  Json schema = study::schema_head(fmt::format("What rondo {} --json prints", command),
                                   "Numbers that are not finite are null; units are in brackets.");
  schema.update(study::closed_object());
  Json& properties = schema["properties"];
  const auto add = [&](const char* name, Json value, const char* meaning) {
    value["description"] = meaning;
    properties[name] = std::move(value);
    schema["required"].push_back(name);
  };
  std::vector<std::string_view> names;
  Json codes = Json::array();
  for (const Status& status : statuses) {
    names.push_back(status.name);
    codes.push_back(status.code);
  }
  add("command", study::one_of({&command, 1}), "whose document it is");
  add("version", {{"type", "string"}}, "of rondo");
  add("build_record", study::schema_of(study::build_record_members()), "what rondo was built from");
  add("status", study::one_of(names), "how it ended");
  add("exit_code", {{"enum", codes}}, "of the program");
  add("message", {{"type", {"string", "null"}}}, "what went wrong; null: nothing");
  add("faults", study::array_of(fault_schema()), "of wrong input: all that were found");
  add("warnings", study::array_of({{"type", "string"}}), "all that were given");
  result["title"] = "what was found";
  add("result", {{"anyOf", {{{"type", "null"}}, std::move(result)}}},
      "what was found; null where the command failed before");
  return schema;
}

}  // namespace rondo::app
