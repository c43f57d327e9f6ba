/* Unity's settings on a board: its output goes by semihosting, below the port, so that a test may mock the port. */
#ifndef CAIRN_TEST_UNITY_CONFIG_H
#define CAIRN_TEST_UNITY_CONFIG_H

void cairn_test_put(int character);
void cairn_test_flush(void);

#define UNITY_OUTPUT_CHAR(character) cairn_test_put(character)
#define UNITY_OUTPUT_FLUSH() cairn_test_flush()

#endif
