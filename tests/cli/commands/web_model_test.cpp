// SPDX-License-Identifier: GPL-3.0-or-later
// Every command that opens a model opens an address: the same answer, with what was fetched.
#include <fmt/format.h>

#include "cli/arguments_fixture.h"
#include "cli/ball_fixture.h"
#include "io/http_server.h"

namespace arete::cli_test {
namespace {

using test::HttpFault;
using test::HttpServer;

class WebModelCommand : public Arguments {
 protected:
  void SetUp() override {
    Arguments::SetUp();
    write("ball.obj", Ball::ball(24, 14));
    ASSERT_EQ(run({"build", "ball.obj", "-o", "ball.amt", "-q"}).code, 0);
    ASSERT_EQ(run({"extract", "ball.amt", "-o", "small.ply", "--max-error", "2%", "-q"}).code, 0);
    ASSERT_EQ(run({"convert", "dem.amt", "-o", "packed.amt", "--packed", "-q"}).code, 0);
  }
  /// Makes packed.amt larger than what the first request brings.
  void packLarge() const {
    makeRaster("large.tif", "fractal", 170, 150);
    ASSERT_EQ(run({"build", "large.tif", "-o", "packed.amt", "--packed", "-q"}).code, 0);
    ASSERT_GT(read("packed.amt").size(), 100'000u);
  }
  struct Ball : Balls {
    using Balls::ball;
    void TestBody() override {}
  };

  std::map<std::string, std::string> served() const {
    std::map<std::string, std::string> files;
    for (const char* name : {"dem.amt", "packed.amt", "ball.amt"}) files[name] = read(name);
    return files;
  }
  /// The words with an address in place of each model.
  static std::vector<std::string> addressed(std::vector<std::string> words, const HttpServer& server) {
    for (std::string& word : words)
      if (word == "dem.amt" || word == "packed.amt" || word == "ball.amt") word = server.address(word);
    return words;
  }
  /// An answer without the names of the models, the times and what was fetched.
  static std::string comparable(Json answer, const HttpServer& server) {
    answer.erase("network");
    for (const char* name : {"seconds", "milliseconds", "queryMilliseconds", "replaced"}) answer.erase(name);
    std::string text = answer.dump();
    for (std::size_t at; (at = text.find(server.address(""))) != text.npos;)
      text.erase(at, server.address("").size());
    for (std::size_t at = 0; (at = text.find("illiseconds\":", at)) != text.npos;) {
      at += 13;
      text.erase(at, text.find_first_of(",}", at) - at);
    }
    return text;
  }
};

TEST_F(WebModelCommand, AnswersAsOfThePlainFile) {
  HttpServer server(served(), {});
  const std::string place = middle();
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"info", "dem.amt", "--curve", "5"},
           {"info", "ball.amt", "--curve", "5"},
           {"height", "dem.amt", "--at", place},
           {"height", "packed.amt", "--at", place},
           {"los", "packed.amt", "--from", place + ",5", "--to", place + ",9"},
           {"viewshed", "dem.amt", "-o", "v.tif", "--observer", place + ",5"},
           {"validate", "packed.amt"},
           {"validate", "ball.amt"},
           {"measure", "small.ply", "ball.amt", "--samples", "50"},
           {"convert", "dem.amt", "-o", "c.amt", "--packed"},
           {"extract", "dem.amt", "-o", "t.ply", "--max-error", "3"},
           {"extract", "packed.amt", "-o", "t.ply", "--max-triangles", "200"},
           {"extract", "ball.amt", "-o", "t.glb", "--max-error", "1%"},
           {"view", "packed.amt", "--headless", "--screenshot", "p.png", "--size", "64x48"}}) {
    std::vector<std::string> local = words, remote = addressed(words, server);
    local.emplace_back("--json");
    remote.emplace_back("--json");
    SCOPED_TRACE(words[0] + " " + words[1]);
    const Outcome wanted = run(local);
    ASSERT_EQ(wanted.code, 0) << wanted.err;
    std::map<std::string, std::string> outputs;
    for (const char* name : {"v.tif", "c.amt", "t.ply", "t.glb", "p.png"})
      if (exists(name)) {
        outputs[name] = read(name);
        fs::remove(path(name));
      }
    const Outcome got = run(remote);
    ASSERT_EQ(got.code, 0) << got.err;
    EXPECT_EQ(comparable(got.json(), server), comparable(wanted.json(), server));
    for (const auto& [name, bytes] : outputs) {
      EXPECT_EQ(read(name) == bytes, true) << name;
      fs::remove(path(name));
    }
    const Json network = got.json()["network"];
    ASSERT_TRUE(network.is_object()) << got.out;
    EXPECT_GT(network["requests"], 0);
    EXPECT_GT(network["bytes"], 0);
    EXPECT_EQ(network["cachedBytes"], 0);
    EXPECT_FALSE(wanted.json().contains("network"));
  }
}

TEST_F(WebModelCommand, InfoReadsTheBeginningAlone) {
  HttpServer server(served(), {});
  for (const char* name : {"dem.amt", "packed.amt", "ball.amt"}) {
    const Json whole = run({"info", name, "--json"}).json(),
               part = run({"info", server.address(name), "--json"}).json();
    EXPECT_EQ(server.requests(name), 1) << name;
    for (const auto& [key, value] : part.items()) {
      if (key == "file" || key == "network" || !whole.contains(key) || value.is_null()) continue;
      EXPECT_EQ(value, whole[key]) << name << " " << key;
    }
    for (const char* key : {"rootError", "curve"}) EXPECT_TRUE(part[key].is_null()) << name;
    const Outcome text = run({"info", server.address(name)});
    EXPECT_NE(text.out.find("at the finest"), std::string::npos) << text.out;
    EXPECT_NE(text.err.find("--curve 12 fetches it"), std::string::npos) << text.err;
  }
}

TEST_F(WebModelCommand, FetchesOnceWithACache) {
  packLarge();
  HttpServer server(served(), {});
  const std::vector<std::string> words = {
      "info", server.address("packed.amt"), "--curve", "5", "--cache", "kept:5MB", "--json"};
  const Json first = run(words).json(), second = run(words).json();
  EXPECT_GT(first["network"]["bytes"].get<int>(), second["network"]["bytes"].get<int>());
  EXPECT_GT(second["network"]["cachedBytes"], 0);
  EXPECT_EQ(second["network"]["requests"], 1);
  EXPECT_EQ(comparable(first, server), comparable(second, server));
  for (const char* bad : {":5MB", "kept:5XB", "kept:5"}) {
    const Outcome refused = run({"info", "dem.amt", "--cache", bad});
    EXPECT_EQ(refused.code, 2) << bad;
    EXPECT_NE(refused.err.find("--cache"), std::string::npos) << refused.err;
  }
  write("file", "x");
  EXPECT_EQ(run({"info", server.address("dem.amt"), "--cache", "file/below"}).code, 3);
}

TEST_F(WebModelCommand, IsRefusedConfined) {
  HttpServer server(served(), {});
  for (const std::string& name : {server.address("dem.amt"), "/vsicurl/" + server.address("dem.amt"),
                                  std::string("/vsis3/bucket/dem.amt")}) {
    const Outcome outcome = run({"info", name, "--confined"});
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  }
  EXPECT_EQ(server.requests("dem.amt"), 0);
}

TEST_F(WebModelCommand, DoesNotShowWhatAnAddressHides) {
  HttpServer server({{"dem.amt?sig=5ecret", read("dem.amt")}}, {});
  for (const char* name : {"dem.amt?sig=5ecret", "none.amt?sig=5ecret"})
    for (const bool isJson : {false, true}) {
      std::vector<std::string> words = {"info", server.address(name), "--cache", "kept"};
      if (isJson) words.emplace_back("--json");
      const Outcome outcome = run(words);
      EXPECT_EQ((outcome.out + outcome.err).find("5ecret"), std::string::npos) << outcome.out << outcome.err;
    }
  for (const auto& entry : fs::directory_iterator(path("kept")))
    EXPECT_EQ(read("kept/" + entry.path().filename().string()).find("5ecret"), std::string::npos);
}

TEST_F(WebModelCommand, EndsOnASignal) {
  packLarge();
  HttpServer server(served(), [](const std::string&, int number) {
    HttpFault fault;
    fault.isStalled = number > 1;
    return fault;
  });
  const auto begin = std::chrono::steady_clock::now();
  const Outcome outcome = run({"info", server.address("packed.amt"), "--curve", "5"}, [&](pid_t child) {
    for (int i = 0; i < 5000 && server.requests("packed.amt") < 2; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    kill(child, SIGINT);
    killIfItHangs(child);
  });
  EXPECT_EQ(outcome.code, 130) << outcome.err;
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(WebModelCommand, SaysWhatTheServerAnswers) {
  for (const auto& [status, words] : std::vector<std::pair<int, std::vector<std::string>>>{
           {404, {"info"}},
           {403, {"validate"}},
           {401, {"height", "--at", "0,0"}},
           {403, {"view", "--headless", "--screenshot", "x.png"}},
           {404, {"extract", "-o", "x.ply", "--max-error", "1"}},
           {401, {"convert", "-o", "x.amt", "--packed"}}}) {
    HttpServer server(served(), [status = status](const std::string&, int) {
      HttpFault fault;
      fault.status = status;
      return fault;
    });
    std::vector<std::string> line = words;
    line.insert(line.begin() + 1, server.address("dem.amt"));
    const Outcome outcome = run(line);
    EXPECT_EQ(outcome.code, 3) << words[0] << outcome.err;
    EXPECT_NE(outcome.err.find(std::to_string(status)), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find(server.address("dem.amt")), std::string::npos) << outcome.err;
    EXPECT_LT(server.requests("dem.amt"), 4) << words[0];
  }
}

}  // namespace
}  // namespace arete::cli_test
