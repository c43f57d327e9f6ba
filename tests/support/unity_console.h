/* Unity's output on a board: semihosting, below the port, so that a test may mock the port. */
#ifndef CAIRN_TEST_UNITY_CONSOLE_H
#define CAIRN_TEST_UNITY_CONSOLE_H

void cairn_test_put(int character);
void cairn_test_flush(void);

#endif
