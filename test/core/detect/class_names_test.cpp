#include "field_fusion/core/detect/class_names.h"

#include "support/detect_fixtures.h"

namespace field_fusion::core {
namespace {

using Names = std::vector<std::string>;

std::vector<std::string> fromMetadata(const std::string& names, int classes) {
  OnnxFile model;
  model.path = "m";
  model.metadata["names"] = names;
  return classNamesOf(model, classes);
}

TEST(ClassNamesOf, ReadsThePythonDictionary) {
  EXPECT_EQ(fromMetadata("{0: 'person', 1: 'traffic light'}", 2), (Names{"person", "traffic light"}));
  EXPECT_EQ(fromMetadata("{1: \"driver's seat\", 0: 'a: b, c'}", 2), (Names{"a: b, c", "driver's seat"}));
  EXPECT_EQ(fromMetadata("['buoy']", 1), (Names{"buoy"}));
}

TEST(ClassNamesOf, RefusesAWrongCountWithBothCounts) {
  EXPECT_EQ(test::faultOf([] { fromMetadata("{0: 'a', 1: 'b'}", 3); }),
            "model 'm', metadata 'names': 2 class names, but the model has 3 classes");
}

TEST(ClassNamesOf, RefusesWhatIsNoDictionary) {
  EXPECT_TRUE(test::says(test::faultOf([] { fromMetadata("", 1); }), "neither a list nor a dictionary"));
  EXPECT_TRUE(test::says(test::faultOf([] { fromMetadata("{0: 'a', 2: 'b'}", 2); }), "lacks class 1"));
  EXPECT_NE(test::faultOf([] { fromMetadata("{0: 'a', 1: ", 2); }), "");
  EXPECT_NE(test::faultOf([] { fromMetadata("{0: ['a'], 1: 'b'}", 2); }), "");
  EXPECT_TRUE(
      test::says(test::faultOf([] { classNamesOf(readOnnxFile(detectFixture("unnamed_classes.onnx")), 2); }),
                 "does not name its classes"));
}

TEST(ContradictionOf, NamesTheFirstClassThatIsCalledOtherwise) {
  OnnxFile model;
  EXPECT_EQ(contradictionOf(model, {"a"}), "") << "the file has no names";
  model.metadata["names"] = "{0: 'cage', 1: 'boat'}";
  EXPECT_EQ(contradictionOf(model, {"cage", "boat"}), "");
  EXPECT_EQ(contradictionOf(model, {"cage", "ship"}), "class 1 is 'ship', in the model file 'boat'");
  EXPECT_EQ(contradictionOf(model, {"cage"}), "") << "its names do not fit the model anyway";
}

TEST(ReadClassNames, TakesOneNameALine) {
  const std::string path = detectTempFile("names.txt", "person\r\n  traffic light \ncar\n\n");
  EXPECT_EQ(readClassNames(path, 3), (Names{"person", "traffic light", "car"}));
}

TEST(ReadClassNames, TakesTheDataSetFilesOfUltralytics) {
  const std::string dictionary =
      detectTempFile("names.yaml", "path: x\nnames:\n  0: person\n  1: traffic light\n");
  EXPECT_EQ(readClassNames(dictionary, 2), (Names{"person", "traffic light"}));
  const std::string list = detectTempFile("list.yml", "names: [cage, buoy]\nnc: 2\n");
  EXPECT_EQ(readClassNames(list, 2), (Names{"cage", "buoy"}));
}

TEST(ReadClassNames, RefusesAWrongCountWithBothCounts) {
  const std::string path = detectTempFile("short.txt", "person\ncar\n");
  EXPECT_EQ(test::faultOf([&] { readClassNames(path, 80); }),
            "class file '" + path + "': 2 class names, but the model has 80 classes");
  EXPECT_TRUE(test::says(test::faultOf([&] { readClassNames(path, 1); }),
                         "2 class names, but the model has 1 classes"));
}

TEST(ReadClassNames, NamesTheFaultOfAFileThatCannotBeUsed) {
  EXPECT_TRUE(test::says(test::faultOf([] { readClassNames("/nowhere/names.txt", 1); }), "cannot be read"));
  EXPECT_TRUE(test::says(test::faultOf([] { readClassNames("/tmp", 1); }), "cannot be read"));
  EXPECT_TRUE(
      test::says(test::faultOf([] { readClassNames(detectTempFile("empty.txt", ""), 1); }), "0 class names"));
  EXPECT_TRUE(test::says(test::faultOf([] { readClassNames(detectTempFile("gap.txt", "a\n\nb\n"), 3); }),
                         "line 2 is empty"));
  EXPECT_TRUE(test::says(test::faultOf([] { readClassNames(detectTempFile("other.yaml", "a: 1\n"), 1); }),
                         "no entry 'names'"));
  EXPECT_TRUE(test::says(test::faultOf([] { readClassNames(detectTempFile("bad.yaml", "names: [a\n"), 1); }),
                         "bad.yaml"));
}

}  // namespace
}  // namespace field_fusion::core
