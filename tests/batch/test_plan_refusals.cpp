#include <gtest/gtest.h>

#include <string>

#include "wilt/batch/plan.hpp"
#include "wilt/core/error.hpp"

namespace wilt {
namespace {

std::string refusal(const std::string& toml) {
  try {
    Plan(toml, "plan.toml", "");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::configuration) << toml;
    return error.what();
  }
  return "not refused";
}

struct Case {
  const char* toml;
  const char* message;  // a part of it: place, what, what is allowed
};

// Each message names the line and what is allowed.
TEST(Plan, RefusesWithLineAndRange) {
  const std::string good = "leaf = \"ivy\"\n[write]\nfiles = \"leaf.glb\"\n";
  const Case cases[] = {
      {"[settings]\nwater.dry_region = [0, 0, 1, 0, 1, 1]", "water.dry_region is a list of numbers"},
      {"[settings]\nexternal.forces = {choice = [1, 2]}", "external.forces is a list of numbers"},
      {"[settings]\nwater.humidty = 0.5",
       "plan.toml, line 5: unknown setting 'water.humidty' (did you mean 'water.humidity'?)"},
      {"[settings]\nwater.humidity = {uniform = [0.5, 1.5]}",
       "line 5: water.humidity must be between 0 and 1"},
      {"[settings]\nwater.humidity = {uniform = [0.9, 0.5]}", "the smaller number comes first"},
      {"[settings]\nwater.humidity = {unifrm = [0, 1]}",
       "line 5: water.humidity takes one value, or how it varies: {uniform = [a, b]}"},
      {"[settings]\nwater.humidity = {uniform = [0, 1], grid = [0.5]}", "varies in two ways"},
      {"[settings]\nwater.humidity = {choice = [0.5, 7]}", "between 0 and 1, not 7"},
      {"[settings]\nwater.humidity = {choice = [0.5, 0.6], weights = [1]}",
       "weights takes a number above 0 for each of the 2"},
      {"[settings]\nwater.humidity = {latin = [0]}", "latin takes two numbers, not 1"},
      {"[settings]\nwater.humidity = {normal = [0.5, -1]}", "the deviation is -1"},
      {"[settings]\nwater.humidity = {normal = [0.5, 1], min = 0.7, max = 0.6}",
       "nothing lies between min and max"},
      {"[settings]\nmodel = {uniform = [0, 1]}", "model must be one of"},
      {"[settings]\niterations = {choice = [1.5]}", "whole number"},
      {"[picture]\nsize = [64, 64]", "line 4: unknown key 'picture' (did you mean 'pictures'"},
      {"[pictures]\nsize = [64]", "size takes two numbers"},
      {"[pictures]\nsize = [8, 64]", "size must be a whole number from 16 to 16384"},
      {"[pictures]\nmaps = [\"veins\"]", "not 'veins' (did you mean 'vein'?)"},
      {"[pictures]\nelevation = {uniform = [0, 100]}", "elevation must be between -90 and 90 degrees"},
      {"[pictures]\nbackground = \"white\"", "colours like \"#eeeae5\""},
      {"[dataset]\nlayouts = [\"coco\"]", "describes pictures; add [pictures]"},
      {"[file]\npetiole = 3", "petiole takes two numbers"},
      {"[settings]\ndt = 0.1\ndt = 0.2", "this is not TOML"},
  };
  EXPECT_EQ(refusal(good), "not refused");
  for (const Case& c : cases) {
    const std::string message = refusal(good + c.toml);
    EXPECT_NE(message.find(c.message), std::string::npos) << c.toml << "\n  " << message;
  }
}

TEST(Plan, RefusesWhatIsNotThere) {
  EXPECT_NE(refusal("[write]\nfiles = \"leaf.glb\"").find("which leaves?"), std::string::npos);
  EXPECT_NE(refusal("leaf = \"ivy\"").find("nothing would be written"), std::string::npos);
  EXPECT_NE(refusal("leaf = {choice = \"photos/*.jpg\"}").find("choice takes a list"), std::string::npos);
  EXPECT_NE(refusal("leaf = {choice = [\"no-such-folder/*.jpg\"]}").find("no file is called"),
            std::string::npos);
  EXPECT_NE(refusal("leaf = \"ivy\"\n[write]\nfiles = \"leaf.xyz\"").find("cannot write 'leaf.xyz'"),
            std::string::npos);
  EXPECT_NE(refusal("leaf = \"ivy\"\n[write]\nfiles = \"../leaf.glb\"").find("the item's own folder"),
            std::string::npos);
  EXPECT_NE(refusal("leaf = \"ivy\"\n[write]\nfiles = [\"a.glb\", \"a.glb\"]").find("twice"),
            std::string::npos);
  EXPECT_NE(refusal(std::string(200, 'a') + std::string(200, '.')).find("plan.toml"), std::string::npos);
}

TEST(Shard, RefusesOthers) {
  for (const char* text : {"", "3", "0/7", "8/7", "1/0", "a/b", "1/7x", "-1/7"}) {
    try {
      parse_shard(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("3/7"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace wilt
